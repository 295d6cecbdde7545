#include "calib/diagnose/judge/moved.h"

#include <algorithm>
#include <cmath>

#include "calib/diagnose/data/thresholds.h"

namespace armcal {
namespace {

const char* const kInertialNames[] = {"mass", "hx",  "hy",  "hz",  "Ixx",
                                      "Ixy",  "Iyy", "Ixz", "Iyz", "Izz"};

// Name, unit and nominal value; no name for a nuisance.
MovedParameter Describe(const BaselineColumn& column, const Robot& robot) {
  MovedParameter parameter;
  if (column.kind == BaselineColumn::Kind::kInertial) {
    const Link& link = robot.links[column.joint];
    parameter.name = link.name + "." + kInertialNames[column.index];
    parameter.unit = column.index == 0  ? "kg"
                     : column.index < 4 ? "kg m"
                                        : "kg m^2";
    parameter.nominal = link.inertial.ToVector()[column.index];
  } else if (column.kind == BaselineColumn::Kind::kTerm ||
             column.kind == BaselineColumn::Kind::kDay) {
    const Joint& joint = robot.links[column.joint].joint;
    const JointTerm term = static_cast<JointTerm>(column.index);
    parameter.name = joint.name + "." + JointTermName(term);
    parameter.unit = JointTermUnit(term, joint.type);
    parameter.nominal = TermOf(term, joint);
  }
  return parameter;
}

}  // namespace

// Parameters of the model that are far from the file's, in units of their
// prior's standard deviation, largest first: where the data have not enough of
// them, a large value is the data's noise, so that they have to be clear of
// their own deviation too. With a reference, columns of the day are told and
// not those that the reference already moved.
std::vector<MovedParameter> ListMoved(const GapFit& fit,
                                      const Eigen::VectorXd& x) {
  const Eigen::MatrixXd covariance = fit.screen().BaselineCovariance();
  const auto& columns = fit.baseline().columns();
  const bool since_reference =
      std::any_of(columns.begin(), columns.end(), [](const auto& column) {
        return column.kind == BaselineColumn::Kind::kDay;
      });
  std::vector<MovedParameter> moved;
  for (int c = 0; c < x.size(); ++c) {
    const BaselineColumn& column = fit.baseline().columns()[c];
    MovedParameter parameter = Describe(column, fit.baseline().robot());
    const double own = std::sqrt(covariance(c, c));
    const double prior = fit.baseline().prior().Stddev(c);
    const bool of_day = column.kind == BaselineColumn::Kind::kDay;
    if (parameter.name.empty() || of_day != since_reference) continue;
    const double least = of_day ? Limits().notable : Limits().far;
    if (std::abs(x[c]) < std::max(least * prior, Limits().far * own)) continue;
    parameter.value = parameter.nominal + x[c] * column.spread;
    parameter.stddev = own * column.spread;
    parameter.deviations = x[c] / prior;
    moved.push_back(parameter);
  }
  std::sort(moved.begin(), moved.end(),
            [](const MovedParameter& a, const MovedParameter& b) {
              return std::abs(a.deviations) > std::abs(b.deviations);
            });
  return moved;
}

}  // namespace armcal

#include "calib/diagnose/judge/moved.h"

#include <algorithm>
#include <cmath>

#include "calib/diagnose/candidates/law_share.h"
#include "calib/diagnose/data/days.h"
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
    parameter.term = term;
  }
  return parameter;
}

// What laws of friction that were found as a change since a reference add to a
// term of a joint along the logs, SI units. Those that the reference shows are
// in the robot's term already, which was fitted to it without them.
struct Added {
  double since = 0;
  double variance = 0;
};

// Whether a law is Coulomb friction in another form. What others (of position,
// load, speed) have on the average of a log says little of another motion.
bool IsCoulomb(const Effect& law) {
  return law.parameters[0].name == "coulomb" && !law.joint_term;
}

// A share is in proportion to its law's first parameter, which is the size of
// each law that terms stand for. Laws that the reference shows come first.
Added AddedByLaws(const RefinedEffects& refined,
                  const std::vector<CarriedEffect>& effects, int joint,
                  JointTerm term) {
  Added added;
  Eigen::Index parameter = 0;
  for (size_t k = effects.size() - refined.effects.size(); k < effects.size();
       ++k) {
    const GapCandidate& found = effects[k].found;
    const bool adds = found.joint == joint && IsCoulomb(*found.effect);
    const double share = adds ? ShareOf(effects[k], term) : 0;
    if (share != 0) {
      added.since += share;
      added.variance += std::pow(share / found.p[0], 2) *
                        refined.covariance(parameter, parameter);
    }
    parameter += found.p.size();
  }
  return added;
}

}  // namespace

// Parameters of the model that are far from the file's, in units of their
// prior's standard deviation, largest first: where the data have not enough of
// them, a large value is the data's noise, so that they have to be clear of
// their own deviation too. With a reference, columns of the day are told and
// not those that the reference already moved; zeros of torques, for which there
// is no prior to speak of, by the size that they have together.
std::vector<MovedParameter> ListMoved(
    const GapFit& fit, const Eigen::VectorXd& x,
    const std::vector<CarriedEffect>& effects) {
  const Eigen::MatrixXd covariance = fit.screen().BaselineCovariance();
  const auto& columns = fit.baseline().columns();
  const bool since_reference =
      std::any_of(columns.begin(), columns.end(), [](const auto& column) {
        return column.kind == BaselineColumn::Kind::kDay;
      });
  const std::vector<int> zeros = NotableZeros(fit.baseline(), x);
  std::vector<MovedParameter> moved;
  for (int c = 0; c < x.size(); ++c) {
    const BaselineColumn& column = fit.baseline().columns()[c];
    MovedParameter parameter = Describe(column, fit.baseline().robot());
    const double prior = fit.baseline().prior().Stddev(c);
    const bool of_day = column.kind == BaselineColumn::Kind::kDay;
    if (parameter.name.empty() || of_day != since_reference) continue;
    Added added;
    if (of_day) {
      added = AddedByLaws(fit.refined(), effects, column.joint,
                          static_cast<JointTerm>(column.index));
    }
    const double change = x[c] + added.since / column.spread;
    const double own = std::sqrt(covariance(c, c) +
                                 added.variance / std::pow(column.spread, 2));
    const bool is_zero = of_day && parameter.term == JointTerm::kOffset;
    const double least = is_zero ? 0 : of_day ? Limits().notable : Limits().far;
    if (is_zero && std::count(zeros.begin(), zeros.end(), c) == 0) continue;
    if (std::abs(change) < std::max(least * prior, Limits().far * own))
      continue;
    parameter.value = parameter.nominal + change * column.spread;
    parameter.stddev = own * column.spread;
    parameter.deviations = change / prior;
    moved.push_back(parameter);
  }
  std::sort(moved.begin(), moved.end(),
            [](const MovedParameter& a, const MovedParameter& b) {
              return std::abs(a.deviations) > std::abs(b.deviations);
            });
  return moved;
}

}  // namespace armcal

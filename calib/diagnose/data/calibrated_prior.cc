#include "calib/diagnose/data/calibrated_prior.h"

#include <algorithm>
#include <cmath>

#include "calib/diagnose/data/day_shares.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using Parameter = ParameterPosterior::Parameter;

bool IsOf(const BaselineColumn& column, const Parameter& parameter) {
  if (column.joint != parameter.link) return false;
  if (!parameter.term) {
    return column.kind == BaselineColumn::Kind::kInertial &&
           column.index == parameter.inertial;
  }
  return column.kind == BaselineColumn::Kind::kTerm &&
         column.index == static_cast<int>(*parameter.term);
}

// Independent of what the calibration does not know of it.
double VarianceOfDays(const Parameter& parameter, const Robot& robot) {
  for (const auto& [term, share] : kShareOfDays) {
    if (parameter.term != term) continue;
    return std::pow(share * TermOf(term, robot.links[parameter.link].joint), 2);
  }
  return 0;
}

}  // namespace

// The posterior of a calibration as the prior of the columns that it told of,
// in units of their spreads: with the correlations that make weakly told
// combinations weakly told here, too. Of another day, friction has the scatter
// from day to day besides, which is independent of what the calibration does
// not know.
ColumnPrior CalibratedPrior(const ParameterPosterior& posterior,
                            double deviations, const Robot& robot,
                            const std::vector<BaselineColumn>& columns,
                            bool another_day) {
  MatrixXd covariance = deviations * deviations * posterior.covariance;
  std::vector<int> which, told;
  std::vector<double> unit;
  for (int c = 0; c < static_cast<int>(columns.size()); ++c) {
    const auto found =
        std::find_if(posterior.parameters.begin(), posterior.parameters.end(),
                     [&](const Parameter& parameter) {
                       return IsOf(columns[c], parameter);
                     });
    if (found == posterior.parameters.end()) continue;
    const int k = static_cast<int>(found - posterior.parameters.begin());
    if (another_day) covariance(k, k) += VarianceOfDays(*found, robot);
    which.push_back(c);
    told.push_back(k);
    unit.push_back(1 / columns[c].spread);
  }
  const auto scale =
      Eigen::Map<const VectorXd>(unit.data(), unit.size()).asDiagonal();
  return {which, scale * covariance(told, told) * scale};
}

}  // namespace armcal

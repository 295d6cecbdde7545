#include "calib/arm_covariance.h"

#include <algorithm>
#include <cmath>

#include "calib/combination.h"
#include "calib/overlap_covariance.h"
#include "calib/posterior.h"
#include "calib/row_covariance.h"
#include "calib/singular_values.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

ArmTrust Weaker(double inertia, const ArmTrust& trust, double geometry) {
  return {inertia, geometry * trust.length, geometry * trust.angle,
          geometry * trust.joint_terms};
}

constexpr double kNoPrior = 1e100;  // a variance
// Of a variance by errors that follow each other.
constexpr double kMostInflation = 1e8;

// Directions in which the data tell less than a prior of these deviations.
std::vector<std::string> UnseenCombinations(const ArmUnknowns& unknowns,
                                            const MatrixXd& data,
                                            const VectorXd& prior) {
  const std::vector<int> free = unknowns.FreeIndices();
  std::vector<std::string> names;
  VectorXd size(free.size());
  for (size_t f = 0; f < free.size(); ++f) {
    const int k = free[f];
    names.push_back(unknowns.name(k));
    // Without a prior: a thousand times what it would be alone.
    size[f] = prior[k] < kNoPrior ? std::sqrt(prior[k])
                                  : 1e3 / std::max(data.col(k).norm(), 1e-150);
  }
  const MatrixXd relative = data(Eigen::all, free) * size.asDiagonal();
  const SingularValues svd = DecomposeSingular(relative);
  Eigen::Index rank = 0;
  while (rank < svd.s.size() && svd.s[rank] > 1) ++rank;
  std::vector<std::string> texts;
  for (const Combination& c : NameCombinations(
           svd.V.rightCols(size.size() - rank), size.cwiseInverse(), names)) {
    texts.push_back(c.text);
  }
  return texts;
}

}  // namespace

ArmCovariance EstimateArmCovariance(const ArmUnknowns& unknowns,
                                    const ArmFit& fit, const ArmTrust& trust,
                                    const ArmValues& at,
                                    const LinkInformation& torques) {
  const std::vector<int> free = unknowns.FreeIndices();
  const MatrixXd poses = fit.PoseRows(at);
  MatrixXd data(torques.R.rows() + poses.rows(), unknowns.size());
  data << torques.R, poses;
  const auto trusting = [&](const ArmTrust& t) {
    return Posterior(data, fit.PriorInformation(t), free);
  };
  const Posterior posterior = trusting(trust);
  const MatrixXd rest =
      posterior.Sandwich(poses) +
      posterior.Sandwich(SquareRoot(fit.PriorInformation(trust)));
  ArmCovariance result;
  result.covariance = RaiseToLogScatter(
      RaiseTo(torques.least + rest.diagonal(),
              rest + posterior.Sandwich(SquareRoot(torques.S))),
      posterior.Gain(), torques.log_sums);
  const ArmTrust weak = Weaker(1, trust, 1);
  const MatrixXd nothing = MatrixXd::Zero(0, data.cols());
  const VectorXd prior =
      Posterior(nothing, fit.PriorInformation(weak), free).Gain().diagonal();
  result.unseen = UnseenCombinations(unknowns, data, prior);
  const VectorXd trusted = trusting(weak).Gain().diagonal();
  const VectorXd untrusted =
      trusting(Weaker(100, trust, 100)).Gain().diagonal();
  const VectorXd independent = posterior.Gain().diagonal();
  for (int k = 0; k < unknowns.size(); ++k) {
    // Errors that follow each other widen an interval, but not beyond what is
    // known without data: there nothing but rounding is left of the equations.
    const double variance = result.covariance(k, k);
    const bool known =
        variance < std::min(prior[k], kMostInflation * independent[k]);
    result.identifiable.push_back(known && unknowns.is_free(k) &&
                                  untrusted[k] < 2 * trusted[k]);
  }
  return result;
}

}  // namespace armcal

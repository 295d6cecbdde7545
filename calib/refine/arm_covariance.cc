#include "calib/refine/arm_covariance.h"

#include <algorithm>
#include <cmath>

#include "calib/linear/overlap_covariance.h"
#include "calib/linear/row_covariance.h"
#include "calib/numerics/posterior.h"
#include "calib/numerics/unseen_combinations.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// The same trust with links to `inertia` and all else `geometry` times as far.
ArmTrust Weaker(double inertia, const ArmTrust& trust, double geometry) {
  return {inertia, geometry * trust.length, geometry * trust.angle,
          geometry * trust.joint_terms};
}

// How much larger errors that follow each other can make a variance.
constexpr double kMostInflation = 1e8;

}  // namespace

// With A the information of the data and P that of the prior, the estimate's
// error is G (scores + P times the prior's error), G = (A + P)^-1. Its
// covariance is
//   G (S + F'F + P) G,
// S being the long-run covariance of the torques' scores and F'F that of the
// poses'. With these as large as A it would be G itself, the posterior's
// covariance; but torque rows overlap, and poses share errors. Deviations are
// raised as those of the linear calibration are.
//
// Whether a parameter is identifiable must not hang on how far the file is
// trusted for it: its variance is compared between a file trusted to 100 % and
// one trusted to a hundred times as little. Where the data tell it, hardly
// anything changes.
ArmCovariance EstimateArmCovariance(const ArmUnknowns& unknowns,
                                    const ArmFit& fit, const ArmTrust& trust,
                                    const PoseInformation& poses,
                                    const LinkInformation& torques,
                                    double torque_constants_stddev) {
  const std::vector<int> free = unknowns.FreeIndices();
  MatrixXd data(torques.R.rows() + poses.rows.rows(), unknowns.size());
  data << torques.R, poses.rows;
  const auto trusting = [&](const ArmTrust& t) {
    return Posterior(data, fit.PriorInformation(t), free);
  };
  const Posterior posterior = trusting(trust);
  const MatrixXd rest =
      posterior.Sandwich(poses.scores) +
      posterior.Sandwich(SquareRoot(fit.PriorInformation(trust)));
  ArmCovariance result;
  result.covariance = RaiseToLogScatter(
      RaiseTo(torques.least + rest.diagonal(),
              rest + posterior.Sandwich(SquareRoot(torques.S))),
      posterior.Gain(), torques.log_sums);
  const ArmTrust weak = Weaker(1, trust, 1);
  const MatrixXd nothing = MatrixXd::Zero(0, data.cols());
  std::vector<std::string> names;
  for (const int k : free) names.push_back(unknowns.name(k));
  const VectorXd prior =
      Posterior(nothing, fit.PriorInformation(weak), free).Gain().diagonal();
  result.unseen = UnseenCombinations(free, names, data, prior);
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
  const MatrixXd by_scale =
      torque_constants_stddev * posterior.Gain() * torques.scale_sums;
  result.covariance += by_scale * by_scale.transpose();
  return result;
}

}  // namespace armcal

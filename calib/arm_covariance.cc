#include "calib/arm_covariance.h"

#include "calib/overlap_covariance.h"
#include "calib/row_covariance.h"
#include "calib/scaled_inverse.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

ArmTrust Weaker(double inertia, const ArmTrust& trust, double geometry) {
  return {inertia, geometry * trust.length, geometry * trust.angle};
}

}  // namespace

ArmCovariance EstimateArmCovariance(const ArmUnknowns& unknowns,
                                    const ArmFit& fit, const ArmTrust& trust,
                                    const ArmValues& at,
                                    const LinkInformation& torques) {
  const std::vector<int> free = unknowns.FreeIndices();
  const MatrixXd data = torques.H + fit.PoseInformation(at);
  const auto inverse = [&](const ArmTrust& t) {
    return ScaledInverse(data + fit.PriorInformation(t), free);
  };
  const MatrixXd gain = inverse(trust);
  const MatrixXd others = fit.PoseInformation(at) + fit.PriorInformation(trust);
  const MatrixXd rest = gain * others * gain.transpose();
  ArmCovariance result;
  result.covariance =
      RaiseToLogScatter(RaiseTo(torques.least + rest.diagonal(),
                                rest + gain * torques.S * gain.transpose()),
                        gain, torques.log_sums);
  const VectorXd trusted = inverse(Weaker(1, trust, 1)).diagonal();
  const VectorXd untrusted = inverse(Weaker(100, trust, 100)).diagonal();
  for (int k = 0; k < unknowns.size(); ++k) {
    result.identifiable.push_back(unknowns.is_free(k) &&
                                  untrusted[k] < 2 * trusted[k]);
  }
  return result;
}

}  // namespace armcal

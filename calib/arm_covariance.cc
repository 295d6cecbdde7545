#include "calib/arm_covariance.h"

#include <Eigen/Cholesky>

#include "calib/row_covariance.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// Inverts positive definite matrices whose units differ by many orders.
MatrixXd ScaledInverse(const MatrixXd& A) {
  const VectorXd s = A.diagonal().cwiseSqrt().cwiseInverse();
  const MatrixXd scaled = s.asDiagonal() * A * s.asDiagonal();
  return s.asDiagonal() *
         scaled.ldlt().solve(MatrixXd::Identity(A.rows(), A.cols())) *
         s.asDiagonal();
}

ArmTrust Weaker(double inertia, const ArmTrust& trust, double geometry) {
  return {inertia, geometry * trust.length, geometry * trust.angle};
}

}  // namespace

ArmCovariance EstimateArmCovariance(const ArmUnknowns& unknowns,
                                    const ArmFit& fit, const ArmTrust& trust,
                                    const ArmValues& at,
                                    const LinkInformation& torques) {
  const std::vector<int> free = unknowns.FreeIndices();
  const MatrixXd poses = fit.PoseInformation(at);
  const auto information = [&](const ArmTrust& t) -> MatrixXd {
    return (torques.H + poses + fit.PriorInformation(t))(free, free);
  };
  const MatrixXd gain = ScaledInverse(information(trust));
  const MatrixXd scores =
      (torques.S + poses + fit.PriorInformation(trust))(free, free);
  const MatrixXd covariance =
      RaiseToLogScatter(gain * scores * gain.transpose(), gain,
                        torques.log_sums(free, Eigen::all));
  const VectorXd trusted =
      ScaledInverse(information(Weaker(1, trust, 1))).diagonal();
  const VectorXd untrusted =
      ScaledInverse(information(Weaker(100, trust, 100))).diagonal();
  ArmCovariance result;
  result.covariance = MatrixXd::Zero(unknowns.size(), unknowns.size());
  result.covariance(free, free) = covariance;
  result.identifiable.assign(unknowns.size(), false);
  for (size_t f = 0; f < free.size(); ++f) {
    const auto k = static_cast<Eigen::Index>(f);
    result.identifiable[free[f]] = untrusted[k] < 2 * trusted[k];
  }
  return result;
}

}  // namespace armcal

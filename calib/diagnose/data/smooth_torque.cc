#include "calib/diagnose/data/smooth_torque.h"

#include <algorithm>

#include "calib/diagnose/data/thresholds.h"
#include "model/signals/low_pass.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::RowVectorXd;

constexpr double kRecordedHz = 3;
constexpr double kReconstructedHz[] = {1.5, 3, 5, 6.5, 8, 10, 12.5, 16, 20};

double Power(const GapSegment& segment, const MatrixXd& band,
             const RowVectorXd& noise) {
  double power = 0;
  for (int k = 0; k < segment.size(); ++k) {
    if (segment.IsLost(segment.motion.time(k))) continue;
    power += band.row(k).cwiseQuotient(noise).squaredNorm();
  }
  return power;
}

// Up to which frequency a reconstructed torque stands out of its noise, band by
// band from low to high: the signal's power in a band over that of one draw of
// its noise, summed over joints in units of their noise, has to be
// smooth_power. The first band that falls short ends it, since what is above
// would be noise.
double ReconstructedHz(const GapSegment& segment) {
  const double rate = 1 / segment.motion.dt;
  const RowVectorXd noise =
      segment.torque_noise.colwise().norm().cwiseMax(1e-300);
  double hz = kReconstructedHz[0];
  MatrixXd tau = ZeroPhaseLowPass(segment.tau, rate, hz);
  MatrixXd error = ZeroPhaseLowPass(segment.torque_noise, rate, hz);
  for (const double next : kReconstructedHz) {
    if (next <= hz) continue;
    const MatrixXd next_tau = ZeroPhaseLowPass(segment.tau, rate, next);
    const MatrixXd next_error =
        ZeroPhaseLowPass(segment.torque_noise, rate, next);
    if (Power(segment, next_tau - tau, noise) <
        Limits().smooth_power * Power(segment, next_error - error, noise)) {
      break;
    }
    hz = next;
    tau = next_tau;
    error = next_error;
  }
  return hz;
}

}  // namespace

// Regressors that are made of the torque itself would have its noise in common
// with the residual, which biases their coefficients (errors in variables,
// Fuller 1987): they are made of this smoother one instead.
SmoothTorque SmoothTorqueOf(const GapSegment& segment) {
  const double hz =
      segment.torque_noise.size() > 0 ? ReconstructedHz(segment) : kRecordedHz;
  return {ZeroPhaseLowPass(segment.tau, 1 / segment.motion.dt, hz), hz};
}

}  // namespace armcal

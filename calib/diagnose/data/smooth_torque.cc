#include "calib/diagnose/data/smooth_torque.h"

#include <algorithm>

#include "calib/diagnose/data/thresholds.h"
#include "model/signals/low_pass.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::RowVectorXd;

constexpr double kRecordedHz = 3;
constexpr double kMadeHz[] = {1.5, 3, 5, 6.5, 8, 10, 12.5, 16, 20};

double Power(const GapSegment& segment, const MatrixXd& band,
             const RowVectorXd& noise) {
  double power = 0;
  for (int k = 0; k < segment.size(); ++k) {
    if (segment.IsLost(segment.motion.time(k))) continue;
    power += band.row(k).cwiseQuotient(noise).squaredNorm();
  }
  return power;
}

// Up to where torques that were made stand out of their noise, band by band.
double MadeHz(const GapSegment& segment) {
  const double rate = 1 / segment.motion.dt;
  const RowVectorXd noise =
      segment.torque_noise.colwise().norm().cwiseMax(1e-300);
  double hz = kMadeHz[0];
  MatrixXd tau = ZeroPhaseLowPass(segment.tau, rate, hz);
  MatrixXd error = ZeroPhaseLowPass(segment.torque_noise, rate, hz);
  for (const double next : kMadeHz) {
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

SmoothTorque SmoothTorqueOf(const GapSegment& segment) {
  const double hz =
      segment.torque_noise.size() > 0 ? MadeHz(segment) : kRecordedHz;
  return {ZeroPhaseLowPass(segment.tau, 1 / segment.motion.dt, hz), hz};
}

}  // namespace armcal

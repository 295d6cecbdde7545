#include "model/signals/recording_delay.h"

#include "model/signals/delayed_signal.h"
#include "model/signals/low_pass.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;

MatrixXd Fast(const MatrixXd& given, double smooth_hz, double dt) {
  return given - ZeroPhaseLowPass(given, 1 / dt, smooth_hz);
}

}  // namespace

MatrixXd ChangeByDelay(const MatrixXd& given, const SmoothTorque& recorded,
                       double dt, double delay) {
  const double samples = delay / dt;
  if (recorded.tau.size() == 0) return Delayed(given, samples) - given;
  const MatrixXd fast = Fast(given, recorded.hz, dt);
  // As it was recorded, and as it was when it was given.
  return Delayed(fast, samples) - fast + recorded.tau -
         Delayed(recorded.tau, -samples);
}

MatrixXd SlopeByDelay(const MatrixXd& given, const SmoothTorque& recorded,
                      double dt) {
  if (recorded.tau.size() == 0) return -Differentiate(given, dt);
  return -Differentiate(Fast(given, recorded.hz, dt) + recorded.tau, dt);
}

}  // namespace armcal

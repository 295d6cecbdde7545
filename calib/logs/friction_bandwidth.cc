#include "calib/logs/friction_bandwidth.h"

#include <algorithm>
#include <cmath>

#include "model/dynamics/joint_term.h"
#include "model/signals/trajectory.h"

namespace armcal {

double FrictionBandwidth(const EncoderNoise& noise, double bandwidth_hz) {
  // int x^2 / (1 + x^8)^2 dx from 0 is B(3/8, 13/8) / 8.
  const double integral = 5 * M_PI / (64 * std::sin(3 * M_PI / 8));
  constexpr double kNoise = CoulombTransition::kSharpestVelocity / 2;
  double widest = kTorqueBand * bandwidth_hz;
  for (Eigen::Index j = 0; j < noise.density.size(); ++j) {
    if (noise.travel[j] < kLeastTravel || noise.density[j] <= 0) continue;
    const double per_cube = 8 * M_PI * M_PI * noise.density[j] * integral;
    widest = std::min(widest, std::cbrt(kNoise * kNoise / per_cube));
  }
  return std::max(widest, bandwidth_hz);
}

}  // namespace armcal

#include "calib/logs/friction_bandwidth.h"

#include <algorithm>
#include <cmath>

#include "model/dynamics/joint_term.h"

namespace armcal {
namespace {

constexpr double kMostVelocityNoise = CoulombTransition::kSharpestVelocity / 2;
constexpr double kMostPositionNoise =
    CoulombTransition::kSharpestDisplacement / 2;

// int x^(2 k) / (1 + x^8)^2 dx from 0 on.
double NoisePower(int k) {
  const double a = (2 * k + 1) / 8.;
  return std::beta(a, 2 - a) / 8;
}

}  // namespace

FrictionBand FrictionBandwidth(const EncoderNoise& noise, double bandwidth_hz) {
  const double widest = kTorqueBand * bandwidth_hz;
  FrictionBand band = {widest, widest};
  for (Eigen::Index j = 0; j < noise.slow_density.size(); ++j) {
    if (noise.travel[j] < kLeastTravel || noise.slow_density[j] <= 0) continue;
    const double per_hz = 2 * noise.slow_density[j] * NoisePower(0);
    const double per_cube =
        8 * M_PI * M_PI * noise.slow_density[j] * NoisePower(1);
    band.position_hz = std::min(
        band.position_hz, kMostPositionNoise * kMostPositionNoise / per_hz);
    band.velocity_hz =
        std::min(band.velocity_hz,
                 std::cbrt(kMostVelocityNoise * kMostVelocityNoise / per_cube));
  }
  band.position_hz = std::max(band.position_hz, bandwidth_hz);
  band.velocity_hz = std::max(band.velocity_hz, bandwidth_hz);
  return band;
}

}  // namespace armcal

#pragma once

#include <Eigen/Core>

#include "calib/logs/log_set.h"

namespace armcal {

// A joint that travels less shows nothing but noise and play, rad or m.
constexpr double kLeastTravel = 2e-3;

// Noise of the recorded positions beside the motion that they are of, per
// joint, all logs together (the first samples of each, as far as they were
// recorded within the crop).
struct EncoderNoise {
  // Power spectral density of white noise, variance of a sample times the time
  // between samples, rad^2 s (m^2 s). Uneven stamps count as noise.
  Eigen::ArrayXd density;
  // Mean square of the acceleration, (rad/s^2)^2 or (m/s^2)^2, less what the
  // noise makes of it.
  Eigen::ArrayXd mean_square_acceleration;
  Eigen::ArrayXd travel;  // largest position less smallest, rad or m
  // Largest recorded torque, N m or N; empty where none is recorded.
  Eigen::ArrayXd torque;
};

// Accelerations are second differences over a quarter period of
// `bandwidth_hz` > 0 either way. One look at rows that are kept in memory, the
// first time.
EncoderNoise MeasureEncoderNoise(const LogSet& logs, double bandwidth_hz);

}  // namespace armcal

#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <random>

namespace armcal {

// How well a robot measures and how its log is kept. Vectors have one entry per
// driven joint or are empty, which means zero.
struct SensorOptions {
  Eigen::VectorXd encoder_resolution;  // rad or m; 0: exact
  Eigen::VectorXd encoder_noise;       // standard deviation, rad or m
  Eigen::VectorXd torque_noise;        // white, standard deviation, N m or N
  Eigen::VectorXd coloured_noise;      // the same, first-order correlated
  double noise_correlation = .05;      // s, of the coloured noise
  double torque_delay = 0;             // s, the log's torque is that much older
  double log_rate_hz = 250;
  double jitter = 0;  // s, standard deviation of sampling instants; stamps tell
  double lost_share = 0;  // of the samples, in gaps of up to 5
  uint64_t seed = 0;      // of the robot
  uint64_t run = 0;       // which of its logs
};

// What encoders report of true positions: noise, then resolution.
class Encoders {
 public:
  Encoders(const SensorOptions& options, int num_joints);
  Eigen::VectorXd Measure(const Eigen::VectorXd& position);

 private:
  Eigen::VectorXd resolution_, noise_;
  std::mt19937_64 random_;
};

// Noise of recorded torques.
class TorqueNoise {
 public:
  TorqueNoise(const SensorOptions& options, int num_joints);
  // For a sample `dt` s after the last one.
  Eigen::VectorXd Next(double dt);

 private:
  Eigen::VectorXd white_, coloured_, state_;
  double correlation_;
  std::mt19937_64 random_, random_coloured_;
};

// Which control periods the log samples.
class SamplingClock {
 public:
  // `periods`: control periods per sample.
  SamplingClock(const SensorOptions& options, int periods, double control_rate);
  // Whether the log has a row at control period `tick`; ask for each in turn.
  bool Samples(long tick);

 private:
  void Schedule();

  int periods_;
  double jitter_periods_, lost_share_;
  long sample_ = -1, next_tick_ = 0;
  int lost_ = 0;  // samples still to be lost
  std::mt19937_64 random_, random_loss_;
};

}  // namespace armcal

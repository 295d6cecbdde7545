#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <vector>

#include "calib/logs/velocity_law.h"
#include "model/log_files/log.h"

namespace armcal {

// Sums over joints i of a step, or over steps: what is told of time. The
// estimates are those of weighted least squares.
struct TimeSums {
  double product = 0;   // sum v dq / s^2
  double square = 0;    // sum v^2 / s^2
  double by_stamp = 0;  // sum v^2 dt / s^2

  void Add(const TimeSums& other) {
    product += other.product;
    square += other.square;
    by_stamp += other.by_stamp;
  }
  double rate() const { return product / by_stamp; }
  double rate_stddev() const { return std::sqrt(square) / by_stamp; }
  double step() const { return product / square; }
  double step_variance() const { return 1 / square; }
};

// What the joints of a log that move as their recorded velocities say tell of
// each step of its clock, and how well each of them does: the noise s of its
// dq. SampleClock has the law.
class StepInformation {
 public:
  explicit StepInformation(const Log& log);

  // Whether two groups of joints tell time independently of each other.
  bool has_groups() const { return has_groups_; }
  const VelocitySteps& steps() const { return steps_; }
  Eigen::Index size() const { return steps_.dt.size(); }
  const std::vector<int>& joints() const { return joints_; }
  double variance(int joint) const { return variance_[joint]; }  // of its dq

  TimeSums OfAll(Eigen::Index step) const { return Sums(joints_, step); }
  TimeSums OfGroup(int group, Eigen::Index step) const {
    return Sums(groups_[group], step);
  }

 private:
  TimeSums Sums(const std::vector<int>& joints, Eigen::Index k) const;
  void EstimateNoise();
  bool MakeGroups();

  const VelocitySteps steps_;
  std::vector<int> joints_;
  Eigen::VectorXd variance_;
  std::array<std::vector<int>, 2> groups_;
  bool has_groups_ = false;
};

}  // namespace armcal

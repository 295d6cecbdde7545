#pragma once

#include <Eigen/Core>
#include <vector>

#include "calib/logs/wiring.h"
#include "model/log_files/log.h"

namespace armcal {

// Rows of `values` at ascending `times`, on straight lines between stamps.
Eigen::MatrixXd Interpolated(const Eigen::VectorXd& stamps,
                             const Eigen::MatrixXd& values,
                             const Eigen::VectorXd& times);

// A log in memory on a uniform grid, low-passed: what questions about a whole
// log are asked of.
class UniformSeries {
 public:
  // Stretches across gaps of more than `longest_gap` s do not count. Motion and
  // torque are low-passed at `bandwidth_hz`. The log has q, tau or not (then
  // tau() is empty and there is nothing to Pick).
  UniformSeries(const Log& log, double dt, double longest_gap,
                double bandwidth_hz);

  double dt() const { return dt_; }
  double bandwidth_hz() const { return bandwidth_hz_; }
  int num_moving() const { return static_cast<int>(moving_.size()); }
  // Rows at which the arm moves, but too near to gaps.
  int num_moving_at_gaps() const { return moving_at_gaps_; }
  // s on both sides of gaps and at the ends.
  double reach() const { return reach_ * dt_; }
  // Low-passed, rows on the grid.
  const Motion& motion() const { return motion_; }
  const Eigen::MatrixXd& tau() const { return tau_; }
  // Rows at which the arm moves, away from gaps and ends.
  const std::vector<int>& moving() const { return moving_; }
  // At most `count` of them, evenly; torques as recorded `delay` s later.
  WiringSamples Pick(int count, double delay) const;

 private:
  double dt_, bandwidth_hz_;
  Motion motion_;
  Eigen::MatrixXd tau_;
  std::vector<int> moving_;
  int moving_at_gaps_ = 0, reach_ = 0;
};

}  // namespace armcal

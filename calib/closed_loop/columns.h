#pragma once

#include <Eigen/Core>
#include <vector>

#include "calib/closed_loop/values.h"
#include "model/dynamics/motion_tangent.h"
#include "model/robot/robot.h"

namespace armcal {

// What a simulated loop's derivatives are taken by, a column each: of the links
// the base inertial parameters, which all others act through; of other values
// those that are free; then the start (q, qd, integral; 3 n).
class LoopColumns {
 public:
  // `free`: by LoopOrder.
  LoopColumns(const Robot& robot, const std::vector<bool>& free);

  struct Gain {
    int joint;
    double DriveLaw::*gain;
    int column;
  };
  const TangentParameters& arm() const { return arm_; }
  const std::vector<Gain>& gains() const { return gains_; }
  int delay() const { return delay_; }  // -1: not free
  int num_values() const { return num_values_; }
  int start() const { return num_values_; }
  int size() const { return num_values_ + 3 * n_; }

  // Derivatives by all values, columns of LoopOrder, are those by columns times
  // this; of values that are not free they are 0.
  const Eigen::MatrixXd& spread() const { return spread_; }

 private:
  int n_;
  TangentParameters arm_;
  std::vector<Gain> gains_;
  int delay_ = -1, num_values_ = 0;
  Eigen::MatrixXd spread_;
};

}  // namespace armcal

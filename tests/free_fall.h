#pragma once

#include <Eigen/Core>

#include "model/robot.h"

namespace armcal {

// What integrators are compared on: the benchmarks' arm falls freely from a
// state of its motion. Its joints have viscous friction and nothing else.
struct FreeFall {
  Robot robot;
  Eigen::VectorXd q, qd;  // n, at the begin
  static constexpr int kSteps = 500;
  static constexpr double kStep = 1e-3;  // s

  // `viscous`: of all joints, N m s/rad.
  explicit FreeFall(double viscous);
  // Largest difference of q at the end to that of adaptive steps of order 5 and
  // 1e-13 each, rad.
  double Error(const Eigen::VectorXd& q_end) const;
};

}  // namespace armcal

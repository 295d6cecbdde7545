#pragma once

#include <Eigen/Core>

#include "model/robot.h"

namespace armcal {

// What integrators are compared on: the benchmarks' arm, whose joints have
// neither friction nor armature, falls freely from a state of its motion.
struct FreeFall {
  Robot robot;
  Eigen::VectorXd q, qd;  // n, at the begin
  static constexpr int kSteps = 500;
  static constexpr double kStep = 1e-3;  // s

  FreeFall();
  // At the end, by adaptive steps of order 5 and 1e-13 each.
  Eigen::VectorXd ExactEnd() const;
  // Largest difference of q to that, rad.
  double Error(const Eigen::VectorXd& q_end) const;
};

}  // namespace armcal

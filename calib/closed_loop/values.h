#pragma once

#include <Eigen/Core>
#include <vector>

#include "model/dynamics/arm_plan.h"
#include "model/dynamics/drive_law.h"
#include "model/dynamics/joint_term.h"

namespace armcal {

// An arm and its controller, as far as they can be estimated.
struct LoopValues {
  RolloutArm arm;  // Coulomb friction by velocity laws
  std::vector<DriveLaw> drives;
  double delay = 0;  // s, of the command
  // Simulated steps of a control period.
  int substeps = 1;
};

// Enough of them for friction some times the values'.
int EnoughSubsteps(const LoopValues& values, double rate_hz);

// The terms of each joint that can be estimated, in this order.
inline constexpr JointTerm kLoopTerms[] = {
    JointTerm::kViscous, JointTerm::kCoulomb, JointTerm::kOffset,
    JointTerm::kArmature};
// Of drives' laws, what can be estimated, in this order.
const std::vector<double DriveLaw::*>& EstimatedGains();

// The order of a loop's values: ten inertial ones per link; kLoopTerms of each
// joint; the width of each joint's Coulomb transition;
// each of EstimatedGains() of all joints; delay.
struct LoopOrder {
  explicit LoopOrder(int num_joints) : n(num_joints) {}
  int terms() const { return 10 * n; }
  int widths() const { return 14 * n; }
  int gains() const { return 15 * n; }
  int delay() const {
    return gains() + n * static_cast<int>(EstimatedGains().size());
  }
  int size() const { return delay() + 1; }
  int n;
};

// Where a window of a log begins.
struct LoopStart {
  Eigen::VectorXd q, qd;     // rad, rad/s, or m
  Eigen::VectorXd integral;  // of the controller, N m or N
};

}  // namespace armcal

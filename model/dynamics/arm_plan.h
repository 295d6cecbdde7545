#pragma once

#include <vector>

#include "model/dynamics/joint_term.h"
#include "model/robot/link_paths.h"
#include "model/robot/robot.h"
#include "model/simd/motion/arm_constants.h"
#include "model/text/aligned_numbers.h"

namespace armcal {

// A torque -stiffness (q - rest) on a joint, N m/rad or N/m; rad or m.
struct JointSpring {
  double stiffness = 0;
  double rest = 0;
};

// A rigid arm with what its joints add to their own torque: viscous and Coulomb
// friction, offset and armature of the robot's joints (joint_term.h), springs.
struct RolloutArm {
  Robot robot;
  // n entries, or none: the default for all joints.
  std::vector<CoulombTransition> transitions;
  std::vector<JointSpring> springs;  // n entries, or none
};

// What the kernels of model/simd have to know of an arm for its forward
// dynamics, prepared once; of one arm in all lanes, or of one in each.
class ArmPlan {
 public:
  ArmPlan(const RolloutArm& arm, int lanes);
  // Arms of the same joints, whose Coulomb friction follows the same laws.
  explicit ArmPlan(const std::vector<const RolloutArm*>& arm_of_lane);
  ArmPlan(const ArmPlan&) = delete;

  const simd::ArmConstants& constants() const { return constants_; }
  int num_joints() const { return constants_.num_joints; }

 private:
  void SetJoints(const std::vector<const RolloutArm*>& arms);
  void AddPath(const std::vector<const RolloutArm*>& arms,
               const LinkPath& path);

  AlignedNumbers values_;
  std::vector<simd::JointKind> joints_;
  // Of a robot that branches, of each path.
  std::vector<LinkPath> links_;
  std::vector<AlignedNumbers> path_values_;
  std::vector<std::vector<simd::JointKind>> path_joints_;
  std::vector<simd::ArmPath> paths_;
  simd::ArmConstants constants_{};
};

}  // namespace armcal

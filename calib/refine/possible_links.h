#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "model/effects/effect.h"
#include "model/robot/robot.h"

namespace armcal {

// A robot whose links can exist and whose torques are nearly those of a robot
// whose links cannot: logs show sums of what links have, and how a sum is
// shared out is for the file's sake only.
struct PossibleLinks {
  Robot robot;
  // How much torques differ in such motion, rms, percent of the joint's rms
  // torque in the log.
  Eigen::VectorXd differs_percent;
};

// Moves inertia between links, and between links and the armature of the joints
// `free_armature`, as little as it takes (StartLinks) from links as they are,
// or as the file has them where they cannot exist: torques of motion in the
// range of `scale` count where they differ by a percent. Where no links come
// near, as a weak joint's torque was fitted that needs negative inertia, the
// file's links count for more than that. Links without inertia stay so. Nothing
// where numbers overflow.
std::optional<PossibleLinks> FindPossibleLinks(
    const Robot& robot, const Robot& file, const MotionScale& scale,
    const std::vector<bool>& free_armature);

}  // namespace armcal

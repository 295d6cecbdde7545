#pragma once

#include <Eigen/Core>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "model/robot/robot.h"

namespace armcal {

// The axes of the joints in the base's frame, all of them at zero.
std::vector<Eigen::Vector3d> AxesAtZero(const Robot& robot);

// What was read of a robot file, for people to hold against the real arm: each
// joint with its type, its axis in the base's frame where all joints are at
// zero, limits, friction and armature; each link with its mass and centre of
// mass in its own frame; gravity and tool.
std::string DescriptionText(const Robot& robot);

// The same as {"joints": [..], "links": [..], "gravity": [x, y, z], "tool":
// name, "notes": [..]}; SI units, null for what the file does not give or
// limit.
nlohmann::json DescriptionJson(const Robot& robot);

}  // namespace armcal

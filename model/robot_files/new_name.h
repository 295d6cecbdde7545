#pragma once

#include <string>

#include "model/robot/robot.h"

namespace armcal {

// A name like `wish`, with as many underscores behind it as it takes, that no
// link and no joint of the robot has, nor its tool: of what a format needs and
// the robot has no name for.
std::string NewName(const Robot& robot, const std::string& wish);

}  // namespace armcal

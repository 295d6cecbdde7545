#pragma once

#include <string>

#include "model/robot/robot.h"
#include "model/text/document.h"

namespace armcal {

// The URDF `file`, with nothing but its numbers changed: inertia of the
// links of `robot`, damping and friction of its joints, and, where `geometry`
// is set, the origins of its joints and of the tool; `base` is the link that
// the robot was read from, empty for the root. Links that are fixed to them, or
// held on them (Robot::held), keep theirs, the moved link gets the rest; where
// the rest could not exist, these links lose their inertia to it. Elements that
// the file lacks are added. Throws InputError where the file is not the
// robot's.
std::string UpdateUrdf(const Document& file, const Robot& robot, bool geometry,
                       const std::string& base = "");

}  // namespace armcal

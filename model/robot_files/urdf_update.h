#pragma once

#include <string>
#include <vector>

#include "model/robot/robot.h"
#include "model/text/document.h"

namespace armcal {

// The URDF `file`, with nothing but its numbers changed: inertia of the
// links of `robot`, damping and friction of its joints, and, where `geometry`
// is set, the origins of its joints and of the tool; `base` is the link that
// the robot was read from, empty for the root. Links that are fixed to them, or
// held on them (Robot::held), keep theirs, the moved link gets the rest. Where
// the rest could not exist, fixed links lose their inertia to it, and held ones
// keep as much as leaves it possible (SplitInertia): the sum stays the robot's,
// so that torques along it do, and each link that moves has inertia. `losses`,
// unless null, gets a sentence for each link where the file differs from what
// either says. Elements that the file lacks are added. Throws InputError where
// the file is not the robot's.
std::string UpdateUrdf(const Document& file, const Robot& robot, bool geometry,
                       const std::string& base = "",
                       std::vector<std::string>* losses = nullptr);

}  // namespace armcal

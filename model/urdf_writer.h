#pragma once

#include <string>
#include <vector>

#include "model/robot.h"

namespace armcal {

// A URDF of the chain alone, without meshes: links with their inertia about
// the centre of mass, joints with limits and dynamics (damping, friction), the
// base link "base_link", the tool as a fixed link if it has a name. What URDF
// has no field for is left out: see UrdfLosses.
std::string MakeUrdf(const Robot& robot);

// The URDF file `path`, with nothing but its numbers changed: inertia of the
// links of `robot`, damping and friction of its joints, and, where `geometry`
// is set, the origins of its joints and of the tool; `base` is the link that
// the robot was read from, empty for the root. Links that are fixed to them
// keep theirs, the moved link gets the rest; where the rest could not exist,
// the fixed links lose their inertia to it. Elements that the file lacks are
// added. Throws InputError where the file is not the robot's.
std::string UpdateUrdf(const std::string& path, const Robot& robot,
                       bool geometry, const std::string& base = "");

// What a URDF cannot say of this robot, a sentence each: armature, constant
// torques, gravity that is not along -z.
std::vector<std::string> UrdfLosses(const Robot& robot);

}  // namespace armcal

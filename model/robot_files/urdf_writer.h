#pragma once

#include <string>
#include <vector>

#include "model/robot_files/robot_format.h"

namespace armcal {

// A URDF of the chain alone, without meshes: links with their inertia about
// the centre of mass, joints with limits and dynamics (damping, friction), the
// base link "base_link", the tool as a fixed link if it has a name. A link
// LINK whose own frame is not at its joint has a fixed link "LINK_frame" there.
// What URDF has no field for is left out: see UrdfLosses.
std::string MakeUrdf(const Robot& robot);

RobotFormat UrdfFormat();
// The same of a URDF file that UpdateUrdf gives other numbers, where links,
// frames and limits stay those of the file.
RobotFormat UpdatedUrdfFormat();

// What a URDF of MakeUrdf cannot say of this robot, a sentence for each kind
// with the joints' values: armature (kg m^2 or kg), constant torques (N m or
// N), gravity that is not along -z; limits that it makes up, frames that are
// links of their own, links without mass.
std::vector<std::string> UrdfLosses(const Robot& robot);

}  // namespace armcal

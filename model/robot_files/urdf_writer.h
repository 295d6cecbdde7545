#pragma once

#include <string>
#include <vector>

#include "model/robot_files/robot_format.h"

namespace armcal {

// A URDF of the chain alone, without meshes: links with their inertia about
// the centre of mass, joints with limits and dynamics (damping, friction), the
// base link "base_link", the tool as a fixed link if it has a name. What URDF
// has no field for is left out: see UrdfLosses.
std::string MakeUrdf(const Robot& robot);

RobotFormat UrdfFormat();

// What a URDF cannot say of this robot, a sentence for each kind with the
// joints' values: armature (kg m^2 or kg), constant torques (N m or N), gravity
// that is not along -z.
std::vector<std::string> UrdfLosses(const Robot& robot);

}  // namespace armcal

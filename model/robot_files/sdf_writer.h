#pragma once

#include <string>

#include "model/robot_files/robot_format.h"

namespace armcal {

// An SDF 1.9 model of the chain, fixed to the world by "base_link": links with
// their inertia about the centre of mass, joints with limits, damping, friction
// and springs; armature as drake:rotor_inertia. All digits are written.
std::string MakeSdf(const RobotDescription& description);

// Lost are constant torques and gains; gravity is the world's.
RobotFormat SdfFormat();

}  // namespace armcal

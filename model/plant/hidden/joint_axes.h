#pragma once

#include <string>

#include "model/dynamics/simulated_robot.h"

namespace armcal {

// Empty, or why a link's rotation never leaves one axis: all revolute joints up
// to the driven joint `joint` are parallel, in any position if in one.
std::string WhyTurnsAboutOneAxis(const SimulatedRobot& robot, int joint);
// Empty, or why a moment of the link's weight moves no joint: there is no
// gravity, or it is along every revolute axis up to the joint.
std::string WhyGravityIsAlongItsAxes(const SimulatedRobot& robot, int joint);

}  // namespace armcal

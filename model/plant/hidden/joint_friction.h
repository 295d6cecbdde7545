#pragma once

#include "model/dynamics/simulated_robot.h"

namespace armcal {

// Adds the ordinary friction of the robot's driven joints (viscous, coulomb,
// offset of robot->robot): Coulomb friction in the plant's zero-velocity law of
// width `zero_velocity`, rad/s (0.3 of it in m/s). Friction heats, the offset
// does not.
void AddJointFriction(double zero_velocity, SimulatedRobot* robot);

}  // namespace armcal

#pragma once

#include <string>

#include "model/robot_files/robot_format.h"

namespace armcal {

// A Python module for Isaac Lab 2.1 and later with what a URDF lacks of the
// joints: actuators(physics_dt) returns the `actuators` of an ArticulationCfg,
// an actuator configuration per joint with armature, Coulomb and viscous
// friction, limits, and the gains of the controller, if any: delayed where
// commands are. Bodies are those of robot.urdf. Friction is a torque or force,
// as in Isaac Sim 5.0 and later.
std::string MakeIsaac(const RobotDescription& description);

// Lost are constant torques, springs, gains of torque, gravity and of
// controllers what a PD loop lacks.
RobotFormat IsaacFormat();

}  // namespace armcal

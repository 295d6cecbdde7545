#pragma once

#include <string>

#include "model/robot_files/robot_format.h"

namespace armcal {

// An MJCF of the chain for MuJoCo 2.2.2 and later: bodies with their principal
// moments, joints with limits, armature, damping, frictionloss, stiffness and
// springref, a motor per joint that takes N m or N (with a bias where the joint
// has a constant torque) or, under a controller, the joint's drive
// (mjcf_drive.h) at time steps of its period, capsules without mass to be
// looked at. Links without mass are joints of the next body that has one. All
// digits are written. Laws of drives beyond these are written as MjcfLaws says,
// which newer versions read, and a delay of the torque as the motors'.
std::string MakeMjcf(const RobotDescription& description);

// Lost are velocity limits; a massless last link is told of.
RobotFormat MjcfFormat();
// The same without laws of drives: for older versions, for other readers of
// MJCF, and for simulators that work with a module's laws.
RobotFormat PlainMjcfFormat();

}  // namespace armcal

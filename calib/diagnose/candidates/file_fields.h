#pragma once

#include <string>
#include <vector>

#include "calib/diagnose/candidates/corrected_robot.h"
#include "model/robot_files/robot_format.h"

namespace armcal {

// Adds the effect to what a robot file says of its joint; whether there is a
// field for it.
bool AddToFile(const CarriedEffect& effect, Joint* joint, JointDrive* drive);

// Whether a file of this format has all of the effect.
bool IsIn(const RobotFormat& format, const CarriedEffect& effect);
// The names of the formats that have it.
std::vector<std::string> FormatsWith(const CarriedEffect& effect);
// Whether files of some format lack it and have another's share in its stead.
bool IsMissingInSome(const CarriedEffect& effect);
// The names of those that have a constant torque of joints.
std::vector<std::string> FormatsWithOffset();
// The names of those that have the robot's delay, if its torque acts late.
std::vector<std::string> FormatsWithDelay(const CorrectedRobot& robot);

}  // namespace armcal

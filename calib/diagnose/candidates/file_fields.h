#pragma once

#include <string>
#include <vector>

#include "calib/diagnose/candidates/corrected_robot.h"
#include "model/robot_files/robot_format.h"

namespace armcal {

// Adds the effect to what a robot file says of its joint; whether there is a
// field for it.
bool AddToFile(const GapCandidate& found, Joint* joint, JointDrive* drive);

// Whether a file of this format has all of the effect.
bool IsIn(const RobotFormat& format, const CarriedEffect& effect);
// The names of the formats that have it.
std::vector<std::string> FormatsWith(const CarriedEffect& effect);
// The names of those that have a constant torque of joints.
std::vector<std::string> FormatsWithOffset();

}  // namespace armcal

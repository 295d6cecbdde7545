#pragma once

#include <string>
#include <vector>

#include "calib/logs/inspection_finding.h"
#include "model/robot/robot.h"

namespace armcal {

// What a robot file lacks, what cannot exist and what looks like a default:
// links without inertia, bodies that cannot be, equal inertias or all centres
// of mass at their frames' origins, inertias that do not suit the arm's size
// (meshes in mm), units that are not rad, kg and m, joints without limits.
// `wide_angles`: what a URDF turns by more than a whole turn (WideAngles).
std::vector<InspectionFinding> AuditRobot(
    const Robot& robot, const std::vector<std::string>& wide_angles = {});

// What need not be wrong but is worth a look: velocity and effort limits that
// are the same on all joints of an arm, three or more, whose links' masses
// differ by a factor of more than three: no maker drives such links alike.
std::vector<std::string> RobotNotes(const Robot& robot);

}  // namespace armcal

#pragma once

#include <vector>

#include "calib/logs/channel_audit.h"
#include "calib/logs/inspection_finding.h"
#include "model/log_files/log.h"
#include "model/robot/robot.h"

namespace armcal {

// Of a log whose positions are in degrees: puts that before all other findings
// and takes out those that follow from it, velocities in rad/s that are not
// the slopes of degrees. Returns which joints' velocities these are.
std::vector<bool> PutPositionUnitFirst(
    const Robot& robot, const Log& log, const StampFigures& stamps,
    std::vector<InspectionFinding>* findings);

}  // namespace armcal

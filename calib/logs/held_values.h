#pragma once

#include <vector>

#include "calib/logs/inspection_finding.h"
#include "model/log_files/log.h"
#include "model/robot/robot.h"

namespace armcal {

// Findings of values that a log repeats although what they measure goes on: of
// rows that repeat the one before in all columns, else of single columns that
// are held over several rows. Rounded values repeat themselves, too: but then
// they go on by about a quantum, where held ones go on by as much as the motion
// has come since. The log has q, tau, qd or not.
std::vector<InspectionFinding> AuditHeldValues(const Robot& robot,
                                               const Log& log);

}  // namespace armcal

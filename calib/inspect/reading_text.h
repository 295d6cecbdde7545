#pragma once

#include "calib/inspect/reading_change.h"
#include "calib/logs/inspection_finding.h"
#include "model/robot/robot.h"

namespace armcal {

// A change in words; `reading` has all of them.
InspectionFinding FindingOf(const ReadingChange& change,
                            const LogReading& reading, const Robot& robot);

}  // namespace armcal

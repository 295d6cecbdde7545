#pragma once

#include "calib/calibrate.h"
#include "calib/calibration_details.h"
#include "tools/report/report_page.h"

namespace armcal {

// What report.html shows of a calibration beside its JSON: torques or
// positions, correlations, and a geometry that was refined.
void DrawCalibration(const Robot& robot, const CalibrationDetails& details,
                     ReportContent* content);

}  // namespace armcal

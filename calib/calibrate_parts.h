#pragma once

#include "calib/calibrate_options.h"
#include "calib/calibrate_summary.h"
#include "calib/log_input.h"
#include "model/robot/robot.h"

namespace armcal {

// The three calibrations of calibrate.h, by what was measured.
CalibrateSummary CalibrateFromTorques(const Robot& robot, const LogInput& logs,
                                      const CalibrateOptions& options);
CalibrateSummary CalibrateFromCommands(const Robot& robot, const LogInput& logs,
                                       const CalibrateOptions& options);
CalibrateSummary CalibrateFromPoses(const Robot& robot,
                                    const CalibrateOptions& options);

}  // namespace armcal

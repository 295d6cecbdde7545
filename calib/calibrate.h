#pragma once

#include "calib/calibrate_options.h"
#include "calib/calibrate_summary.h"
#include "model/robot/robot.h"

namespace armcal {

// Calibrates a robot from logs of positions and torques, or from commands and
// positions with `options.commands`, or from poses alone where there are no
// logs. Throws InputError for what files and arrays hold, OptionError for
// options that do not go together. What cannot be solved is a result.
CalibrateSummary Calibrate(const Robot& robot, const LogInput& logs,
                           const CalibrateOptions& options);

}  // namespace armcal

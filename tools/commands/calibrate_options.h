#pragma once

#include <string>
#include <vector>

#include "calib/calibrate.h"
#include "tools/command.h"

namespace armcal {

// The logs that are calibrated on; none where there are measured poses alone.
LogInput CalibrationLogsFromFlags(const CommandInput& input);

// What the flags of armcal calibrate ask for. Throws UsageError and, for what
// the file of --poses holds, InputError.
CalibrateOptions CalibrateOptionsFromFlags(const CommandInput& input,
                                           const Robot& robot);

// The files that a calibration is made of, but for the robot's.
std::vector<std::string> CalibrationFilesFromFlags(const CommandInput& input);

}  // namespace armcal

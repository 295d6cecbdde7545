#pragma once

#include <string>
#include <vector>

#include "calib/log_input.h"
#include "calib/refine/calibration_reader.h"

namespace armcal {

// The logs that a calibration was fitted to, as far as they can be read again.
struct CalibrationLogs {
  LogInput input;       // none where one of them cannot
  std::string missing;  // why, a sentence; empty: nothing is
};

// `file`: the calibration.json. A log is looked for where calibrate found it,
// from the current folder and from those that the calibration is in, and is
// itself if its bytes are those of the provenance.json beside `file`. Those
// that are `used` otherwise are left out: nothing else is to be learnt of them.
CalibrationLogs FindCalibrationLogs(const std::string& file,
                                    const CalibratedRobot& calibrated,
                                    const std::vector<LogSource>& used);

}  // namespace armcal

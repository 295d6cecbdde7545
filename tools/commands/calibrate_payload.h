#pragma once

#include <optional>

#include "calib/drive_gains/drive_gains.h"
#include "calib/linear/calibration.h"
#include "model/log_files/log_reader.h"
#include "model/robot/robot.h"
#include "tools/command.h"

namespace armcal {

// The torque constants that --payload_mass and --payload_log ask to estimate
// from the logs' currents; nothing where neither flag is given. Solved, they
// become those of `log_options`.
std::optional<DriveGains> DriveGainsFromFlags(
    const CommandInput& input, const Robot& robot,
    const LinearCalibrationOptions& options, LogReaderOptions* log_options);

// What there is to tell of gains that are not solved.
CommandOutcome UnsolvedGains(const CommandInput& input, const Robot& robot,
                             const DriveGains& gains);

}  // namespace armcal

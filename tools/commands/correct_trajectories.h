#pragma once

#include <string>

#include "calib/linear/calibration.h"
#include "calib/logs/log_set.h"
#include "model/robot/robot.h"
#include "tools/flag_values.h"

namespace armcal {

// Throws UsageError where --trajectory=corrected does not go with other flags.
void CheckTrajectoryFlag(const FlagValues& flags,
                         const LinearCalibrationOptions& options);

// With --trajectory=corrected refines *result (RefineTrajectories) and returns
// what a person reads about it; else nothing.
std::string CorrectTrajectories(const FlagValues& flags, const Robot& robot,
                                const LinearCalibrationOptions& options,
                                const LogSet& training,
                                const LogSet* validation,
                                LinearCalibration* result);

}  // namespace armcal

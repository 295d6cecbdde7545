#pragma once

#include <string>

#include "calib/linear_calibration.h"
#include "calib/log_set.h"
#include "model/robot.h"

namespace armcal {

// Throws UsageError where --trajectory=corrected does not go with other flags.
void CheckTrajectoryFlag(const LinearCalibrationOptions& options);

// With --trajectory=corrected refines *result (RefineTrajectories) and returns
// what a person reads about it; else nothing.
std::string CorrectTrajectories(const Robot& robot,
                                const LinearCalibrationOptions& options,
                                LogSet* training, LogSet* validation,
                                LinearCalibration* result);

}  // namespace armcal

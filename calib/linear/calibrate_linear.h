#pragma once

#include "calib/linear/calibration.h"
#include "calib/logs/log_set.h"
#include "model/robot/robot.h"

namespace armcal {

// Calibrates the model parameters of `robot` from the training logs, and checks
// them on the validation logs, if any (null: none). The robot's inertias do not
// enter the estimate; they only help to judge what is a small torque. Bad input
// throws InputError; a calibration that cannot be solved is a result.
LinearCalibration CalibrateLinear(const Robot& robot,
                                  const LinearCalibrationOptions& options,
                                  const LogSet& training,
                                  const LogSet* validation);

}  // namespace armcal

#pragma once

#include <string>

#include "calib/fleet/reduction.h"
#include "calib/logs/log_set.h"
#include "model/robot/robot.h"

namespace armcal {

// The model of a robot's logs by `options`: bandwidth, window and transitions
// of Coulomb friction that these leave open are chosen as a calibration on all
// of `logs` would. Throws InputError.
ReductionModel ChooseReductionModel(const Robot& robot,
                                    const std::string& robot_sha256,
                                    const LinearCalibrationOptions& options,
                                    const LogSet& logs);

// Reduces a set of one log. The log is calibrated alone first, which takes
// gross errors out of its torque, gives its rows their robust weights (but
// where the loss is squared) and tells how much more its standard deviations
// are than those of independent rows; the rows then go into the factor. No
// hash, unit or time is set. Throws InputError.
ReducedLog ReduceLog(const Robot& robot, const ReductionModel& model,
                     const Progress& progress, const LogSet& log);

}  // namespace armcal

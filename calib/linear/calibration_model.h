#pragma once

#include <optional>
#include <vector>

#include "calib/linear/calibration.h"
#include "calib/logs/prepared_logs.h"
#include "model/dynamics/joint_term.h"
#include "model/dynamics/model_parameters.h"
#include "model/robot/robot.h"
#include "problems/identification_rows.h"

namespace armcal {

// Per joint, the transitions of Coulomb friction that have a column; no joints
// where the model has no Coulomb friction.
using Transitions = std::vector<std::vector<CoulombTransition>>;

// The rows and the parameters that calibration options ask for.
RowOptions MakeRowOptions(const LinearCalibrationOptions& options,
                          const LogSet& training);
// How logs are prepared for the rows.
PreparationOptions PreparationForRows(const RowOptions& rows,
                                      bool remove_spikes = true);
ModelParameters MakeParameters(const Robot& robot,
                               const LinearCalibrationOptions& options,
                               const Transitions& transitions);
// Of the options; nothing where they are to be fitted.
std::optional<Transitions> GivenTransitions(
    const Robot& robot, const LinearCalibrationOptions& options);

}  // namespace armcal

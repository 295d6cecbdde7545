#pragma once

#include "calib/linear/calibration_model.h"

namespace armcal {

// Whether the joints' torques are in one unit, or each joint's currents in one
// of its own, so that equations of different joints do not share parameters.
enum class TorqueUnits { kCommon, kPerJoint };

// One transition of Coulomb friction per joint, fitted on the training logs in
// two passes (a coarse grid, a finer one about its best); none where the model
// has no Coulomb friction; the options' own where they give one.
Transitions FindTransitions(const Robot& robot,
                            const LinearCalibrationOptions& options,
                            const RowOptions& rows,
                            const PreparedLogs& training,
                            TorqueUnits scale = TorqueUnits::kCommon);

// The widths anew, each joint's law as found before: for logs some of whose
// torque samples have been replaced since. One pass.
Transitions FollowTransitions(const Robot& robot,
                              const LinearCalibrationOptions& options,
                              const RowOptions& rows,
                              const std::vector<CoulombTransition>& found,
                              const PreparedLogs& training);

}  // namespace armcal

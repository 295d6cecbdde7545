#pragma once

#include "calib/linear/calibration.h"
#include "model/robot/robot.h"
#include "tools/flag_values.h"

namespace armcal {

// --geometry --identification --solver --joint_terms --coulomb_width --window
// --intervals --interval --quadrature, with --loss and --bandwidth: the
// equations of a linear calibration and how they are solved. Throws UsageError.
LinearCalibrationOptions LinearOptionsFromFlags(const FlagValues& flags,
                                                const Robot& robot);

}  // namespace armcal

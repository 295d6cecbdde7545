#pragma once

#include <string>
#include <vector>

#include "calib/linear/calibration.h"
#include "model/robot/robot.h"

namespace armcal {

// A sentence for each joint whose fitted Coulomb friction changes sign over the
// largest width that is tried: viscous friction then takes a part of it, and
// neither is what it says. None where the widths were given.
std::vector<std::string> TransitionWarnings(const Robot& robot,
                                            const LinearCalibration& result);

}  // namespace armcal

#pragma once

#include <string>
#include <vector>

#include "calib/linear/calibration.h"
#include "model/robot/robot.h"

namespace armcal {

// Sentences about what the fit by itself does not show. One for each joint
// whose inertia about its axis (with its armature) or friction came out below
// zero by four standard deviations: a linear fit has no bounds, and torques
// whose sign is wrong fit it as well as the right ones. One for each joint
// whose fitted Coulomb friction changes sign over the largest width that is
// tried (none where the widths were given): viscous friction then takes a part
// of it, and neither is what it says. One where joints leave more than twice as
// much of the torque held out, N m or N rms and as a share of the torque, as
// where it was fitted.
std::vector<std::string> CalibrationWarnings(const Robot& robot,
                                             const LinearCalibration& result);

}  // namespace armcal

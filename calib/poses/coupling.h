#pragma once

#include <optional>

#include "calib/poses/calibration.h"
#include "model/log_files/pose_reader.h"
#include "model/robot/robot.h"

namespace armcal {

// The one linear relation between joints that explains most of what geometry
// leaves of measured poses: q_i + k q_j for every pair of joints, and (1 + k)
// q_i. Controllers that count an elbow from the ground, wrists whose gears
// turn each other and wrong gear ratios make them. All poses count alike, since
// a robust loss gives up those that would show it. Empty where no relation is
// clear: by what it explains, on poses that were left out, and before all
// others.
std::optional<PoseCoupling> FindCoupling(const Robot& robot,
                                         const PoseMeasurements& measured,
                                         const PoseCalibrationOptions& options);

}  // namespace armcal

#pragma once

#include "calib/diagnose/data/segment.h"
#include "model/signals/motion.h"

namespace armcal {

// A segment's torque without its noise, which a regressor of what the torque
// itself says must not hold. Recorded torques are low-passed at 3 Hz; those
// reconstructed from positions as far up as they stand well above what the
// positions' noise makes of them.
SmoothTorque SmoothTorqueOf(const GapSegment& segment);

}  // namespace armcal

#pragma once

#include <vector>

#include "calib/diagnose/data/baseline.h"
#include "calib/diagnose/data/rows.h"
#include "model/dynamics/recorded_torque.h"
#include "model/effects/effect.h"

namespace armcal {

// What the joints do in these rows.
MotionScale ScaleOf(const GapBaseline& baseline, const GapRows& rows,
                    const std::vector<RecordedTorque>& torques);

}  // namespace armcal

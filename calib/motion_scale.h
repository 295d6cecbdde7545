#pragma once

#include <vector>

#include "calib/gap_baseline.h"
#include "calib/gap_rows.h"
#include "model/effects/effect.h"
#include "model/recorded_torque.h"

namespace armcal {

// What the joints do in these rows.
MotionScale ScaleOf(const GapBaseline& baseline, const GapRows& rows,
                    const std::vector<RecordedTorque>& torques);

}  // namespace armcal

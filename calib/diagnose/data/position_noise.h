#pragma once

#include <Eigen/Core>

#include "calib/diagnose/data/baseline.h"
#include "calib/diagnose/data/noise.h"
#include "calib/diagnose/data/rows.h"

namespace armcal {

// Noise of the residual of torques that were reconstructed from commands and
// positions: a draw of the positions' noise, through the drives and against the
// inverse dynamics of the baseline's robot. Standstill says nothing of it,
// where friction holds what the integrals wind up, and repeats hold the
// reversals of friction, which have an extra variance of their own (GapData).
// The rows' segments have such draws.
GapNoise NoiseOfPositions(const GapBaseline& baseline, const GapRows& rows);

}  // namespace armcal

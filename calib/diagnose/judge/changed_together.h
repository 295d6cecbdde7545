#pragma once

#include <vector>

#include "calib/diagnose/judge/found_effect.h"
#include "calib/diagnose/judge/removed_share.h"
#include "calib/diagnose/select/fit.h"

namespace armcal {

// Friction that differs from the reference's on several joints together, as
// temperature makes it, and zeros of torques that do: one effect per term,
// given the fit's effects.
std::vector<FoundEffect> ListChangedTogether(const GapFit& fit);

// FoundEffect::over_change of an effect on this joint that lowers the held-out
// mean square by `gain`.
double OverChangedFriction(const GapFit& fit, const GapFigures& torque,
                           int joint, double gain);

}  // namespace armcal

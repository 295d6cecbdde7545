#pragma once

#include "model/dynamics/arm_dynamics.h"

namespace armcal {

// An engine's terms `share` (0 to 1) of the way through a step, on the parabola
// through those at its begin, middle and end.
void InterpolateTerms(const ArmTerms& begin, const ArmTerms& middle,
                      const ArmTerms& end, double share, ArmTerms* now);

}  // namespace armcal

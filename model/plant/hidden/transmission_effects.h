#pragma once

#include <vector>

#include "model/plant/hidden/hidden_effect.h"

namespace armcal {

// What yields between motor and link: elasticity, backlash; outside the
// catalogue belt_slip.
std::vector<HiddenEffect> TransmissionEffects();

}  // namespace armcal

#pragma once

#include <vector>

#include "model/plant/hidden/hidden_effect.h"

namespace armcal {

// What sensors and the clock say: encoder_offset, time_base; outside the
// catalogue wandering_encoder, encoder_eccentricity, aging_tachometer.
std::vector<HiddenEffect> SensorEffects();

}  // namespace armcal

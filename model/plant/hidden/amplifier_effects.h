#pragma once

#include <vector>

#include "model/plant/hidden/hidden_effect.h"

namespace armcal {

// Maps from commanded to given torque without a memory: torque_offset,
// torque_gain, torque_nonlinearity, torque_saturation, torque_deadband.
std::vector<HiddenEffect> AmplifierEffects();

}  // namespace armcal

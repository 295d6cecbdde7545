#pragma once

#include <vector>

#include "model/plant/hidden/hidden_effect.h"

namespace armcal {

// Friction that depends on more than the joint's own velocity: load_friction,
// position_friction, coupled_friction, thermal_friction.
std::vector<HiddenEffect> ConditionalFriction();

}  // namespace armcal

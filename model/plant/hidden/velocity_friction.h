#pragma once

#include <vector>

#include "model/plant/hidden/hidden_effect.h"

namespace armcal {

// Friction that depends on the joint's velocity alone: viscous_friction,
// coulomb_friction, asymmetric_friction, quadratic_friction, stribeck.
std::vector<HiddenEffect> VelocityFriction();

}  // namespace armcal

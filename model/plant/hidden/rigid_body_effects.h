#pragma once

#include <vector>

#include "model/plant/hidden/hidden_effect.h"

namespace armcal {

// Another rigid arm: armature, link_length, base_tilt, payload, added_mass,
// link_inertia.
std::vector<HiddenEffect> RigidBodyEffects();

}  // namespace armcal

#pragma once

#include <vector>

#include "model/plant/hidden/hidden_effect.h"

namespace armcal {

// A base that sways, outside the catalogue: mount_resonance.
std::vector<HiddenEffect> MountResonance();

}  // namespace armcal

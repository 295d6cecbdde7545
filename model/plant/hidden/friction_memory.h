#pragma once

#include <vector>

#include "model/plant/hidden/hidden_effect.h"

namespace armcal {

// Friction with a memory or a time of its own: presliding; outside the
// catalogue approach_friction and dragging_brake.
std::vector<HiddenEffect> FrictionMemory();

}  // namespace armcal

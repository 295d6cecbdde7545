#pragma once

#include <vector>

#include "model/plant/hidden/hidden_effect.h"

namespace armcal {

// Torques of the position: spring, cable, torque_ripple.
std::vector<HiddenEffect> PositionTorques();

}  // namespace armcal

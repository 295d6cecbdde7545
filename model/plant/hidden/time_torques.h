#pragma once

#include <vector>

#include "model/plant/hidden/hidden_effect.h"

namespace armcal {

// Torques of time: time_drift, vibration; outside the catalogue random_torque.
std::vector<HiddenEffect> TimeTorques();

}  // namespace armcal

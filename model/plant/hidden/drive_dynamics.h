#pragma once

#include <vector>

#include "model/plant/hidden/hidden_effect.h"

namespace armcal {

// Maps from commanded to given torque with states: delay, torque_crosstalk;
// outside the catalogue supply_sag and warming_motor.
std::vector<HiddenEffect> DriveDynamics();

}  // namespace armcal

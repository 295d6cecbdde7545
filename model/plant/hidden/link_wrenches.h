#pragma once

#include <vector>

#include "model/plant/hidden/hidden_effect.h"

namespace armcal {

// What acts on a link: external_contact; outside the catalogue slosh,
// gyroscope, loose_bolt.
std::vector<HiddenEffect> LinkWrenches();

}  // namespace armcal

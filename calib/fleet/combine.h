#pragma once

#include <string>
#include <utility>
#include <vector>

#include "calib/fleet/reduction.h"

namespace armcal {

// Puts reductions together, each with the name of the file it is from. Throws
// InputError where they are of different models or hold a log twice.
Reduction Combine(const std::vector<std::pair<std::string, Reduction>>& parts);

}  // namespace armcal

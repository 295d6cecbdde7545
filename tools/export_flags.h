#pragma once

#include <string>
#include <vector>

#include "tools/flag_values.h"

namespace armcal {

// --export: the formats that the robot is written in. UsageError for any other.
std::vector<std::string> ExportFromFlags(const FlagValues& flags);

}  // namespace armcal

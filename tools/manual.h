#pragma once

#include <string>
#include <vector>

#include "tools/command.h"

namespace armcal {

// armcal.1 in roff, of the table of commands and their flags.
std::string ManualPage(const std::vector<Command>& commands);

}  // namespace armcal

#pragma once

#include "tools/command.h"

namespace armcal {

// armcal inspect: what a robot file and logs hold, and what is wrong with them.
Command InspectCommand();

}  // namespace armcal

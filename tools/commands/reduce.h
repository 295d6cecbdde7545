#pragma once

#include "tools/command.h"

namespace armcal {

// armcal reduce: logs to factor files.
Command ReduceCommand();

}  // namespace armcal

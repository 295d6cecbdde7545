#pragma once

#include "tools/command.h"

namespace armcal {

// Whether there are measured poses (--poses) and no log.
bool PosesAloneFromFlags(const FlagValues& flags);

// Calibrates the geometry alone.
CommandOutcome CalibratePosesFromFlags(const CommandInput& input);

}  // namespace armcal

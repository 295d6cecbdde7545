#pragma once

#include "tools/command.h"

namespace armcal {

// Whether there is a controller (--controller) whose commands and measured
// positions are what to calibrate on.
bool CommandedFromFlags(const FlagValues& flags);

// Calibrates the arm and its controller without torques: output error.
CommandOutcome CalibrateCommandedFromFlags(const CommandInput& input);

}  // namespace armcal

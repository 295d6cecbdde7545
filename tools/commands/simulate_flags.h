#pragma once

#include "model/plant/hidden/scenario.h"
#include "tools/command.h"

namespace armcal {

// The robot, motion, sensors and hidden effects that the flags of armcal
// simulate ask for. Throws UsageError and InputError.
Scenario ScenarioFromFlags(const CommandInput& input);

}  // namespace armcal

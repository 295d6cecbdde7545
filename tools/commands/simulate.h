#pragma once

#include "tools/command.h"

namespace armcal {

// armcal simulate: the log of a robot with hidden effects, by Simbody.
Command SimulateCommand();

}  // namespace armcal

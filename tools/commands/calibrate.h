#pragma once

#include "tools/command.h"

namespace armcal {

// armcal calibrate: a robot and its logs to model parameters.
Command CalibrateCommand();

}  // namespace armcal

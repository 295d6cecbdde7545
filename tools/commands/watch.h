#pragma once

#include "tools/command.h"

namespace armcal {

// armcal watch: a running log against a calibration.
Command WatchCommand();

}  // namespace armcal

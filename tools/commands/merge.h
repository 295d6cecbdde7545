#pragma once

#include "tools/command.h"

namespace armcal {

// armcal merge: factor files to a calibration, and what units of one robot
// differ in.
Command MergeCommand();

}  // namespace armcal

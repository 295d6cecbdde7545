#pragma once

#include "model/robot.h"

namespace armcal {

// Whether there are measured poses (--poses) and no log.
bool PosesAloneFromFlags();

// Calibrates the geometry alone.
int CalibratePosesFromFlags(const Robot& robot);

}  // namespace armcal

#pragma once

#include "model/robot.h"

namespace armcal {

// armcal calibrate --poses=FILE without a log: the geometry alone.
int CalibratePosesFromFlags(const Robot& robot);

}  // namespace armcal

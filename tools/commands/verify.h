#pragma once

#include "tools/command.h"

namespace armcal {

// armcal verify: a robot or a calibration against Simbody and a log.
Command VerifyCommand();

}  // namespace armcal

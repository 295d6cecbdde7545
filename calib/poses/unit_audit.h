#pragma once

#include <string>

#include "model/log_files/pose_reader.h"
#include "model/robot/robot.h"

namespace armcal {

// Says in which units poses were meant that do not follow the joints as they
// are read, and what the header has to have: degrees that are taken for
// radians, millimetres for metres, or the reverse. Empty where they follow, or
// where other units do not make them follow either.
std::string WrongUnits(const Robot& robot, const PoseMeasurements& measured);

// Throws OptionError of the option that names the poses where it says so.
void RequireUnits(const Robot& robot, const PoseMeasurements& measured,
                  const char* option);

}  // namespace armcal

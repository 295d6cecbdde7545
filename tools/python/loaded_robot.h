#pragma once

#include <string>

#include "model/robot/robot.h"
#include "model/text/document.h"

namespace armcal {

// A robot with what it was read from, which commands hash and whose text they
// keep where they write a robot file.
struct LoadedRobot {
  Robot robot;
  Document file;
  std::string base, tip;
};

}  // namespace armcal

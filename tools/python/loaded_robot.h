#pragma once

#include <string>

#include "model/robot/robot.h"

namespace armcal {

// A robot with where it was read from, which commands hash and whose text
// they keep where they write a robot file.
struct LoadedRobot {
  Robot robot;
  std::string path, base, tip;
};

}  // namespace armcal

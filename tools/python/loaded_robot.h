#pragma once

#include <map>
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
  std::map<std::string, double> posture;  // where joints beside these are held
  std::string folder;  // of files that an MJCF file names; empty: its own
};

}  // namespace armcal

#pragma once

#include <optional>
#include <string>

#include "model/text/document.h"

namespace armcal {

// What a robot was read from.
struct RobotSource {
  std::string name;  // its file's, in messages; empty: the robot's own
  // A URDF whose meshes, names and other links robot.urdf of a result keeps;
  // none: that is a URDF of the chain alone.
  std::optional<Document> urdf;
  std::string base;    // the link that the arm starts at, as it was asked for
  std::string sha256;  // of the file, which factor files name; empty: unknown
};

}  // namespace armcal

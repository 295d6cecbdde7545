#pragma once

#include <vector>

#include "model/robot_files/robot_format.h"

namespace armcal {

// All formats. To add one, write its file and a line here.
const std::vector<RobotFormat>& RobotFormats();

}  // namespace armcal

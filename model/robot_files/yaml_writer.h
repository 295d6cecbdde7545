#pragma once

#include <string>

#include "model/robot_files/robot_format.h"

namespace armcal {

// The robot as ReadYaml reads it: a robot of a DH table by its rows, as long as
// its pose is such rows', any other by poses, which are the same bit for bit.
std::string MakeYaml(const RobotDescription& description);

// Lost are springs and gains.
RobotFormat YamlFormat();

}  // namespace armcal

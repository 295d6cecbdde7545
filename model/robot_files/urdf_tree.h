#pragma once

#include <string>

#include "model/robot_tree/robot_tree.h"
#include "model/text/document.h"

namespace armcal {

// Reads every link and joint of a URDF file and ties them to trees: each link
// has at most one parent joint and there are no loops. Throws InputError.
RobotTree ReadUrdfTree(const Document& document);

}  // namespace armcal

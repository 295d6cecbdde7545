#pragma once

#include <string>
#include <vector>

#include "model/robot_tree/robot_tree.h"
#include "model/text/document.h"

namespace armcal {

// Reads every link and joint of a URDF file and ties them to trees: each link
// has at most one parent joint and there are no loops. Throws InputError.
RobotTree ReadUrdfTree(const Document& document);

// What a URDF turns by more than a whole turn, "joint elbow by 90 rad": there
// is no need to, unless its angles are in degrees. Throws InputError for what
// is no XML.
std::vector<std::string> WideAngles(const Document& document);

}  // namespace armcal

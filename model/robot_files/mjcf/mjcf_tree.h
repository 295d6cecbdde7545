#pragma once

#include <string>

#include "model/robot_tree/robot_tree.h"
#include "model/text/document.h"

namespace armcal {

// Reads the bodies and joints of an MJCF file as a tree whose root is "world".
// Bodies without joints are fixed to their parents; a body with several has a
// massless link for each but the last. Names that are missing are made up:
// "body2", "joint3". `folder` is RobotReaderOptions::folder. What is wrong with
// one body or joint is its `error`. Throws InputError.
RobotTree ReadMjcfTree(const Document& document, const std::string& folder);

}  // namespace armcal

#pragma once

#include "model/robot/robot.h"
#include "model/robot_tree/robot_reader_options.h"
#include "model/text/document.h"

namespace armcal {

// Reads the chain base..tip of an MJCF file, see MakeTreeRobot; the root is
// "world", gravity the file's. Strict, as ReadUrdf is. Default classes, all
// orientations, inertia of primitive geoms and several joints in a body are
// read as MuJoCo reads them, and files that <include> names; ball and free
// joints and couplings on the chain and what MuJoCo makes bodies from are
// refused. Noted and not used: springs, gravcomp, what lies outside the chain.
// Throws InputError.
Robot ReadMjcf(const Document& file, const RobotReaderOptions& options);

}  // namespace armcal

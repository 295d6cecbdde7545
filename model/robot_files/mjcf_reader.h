#pragma once

#include "model/robot/robot.h"
#include "model/robot_files/robot_reader_options.h"
#include "model/text/document.h"

namespace armcal {

// Reads the chain base..tip of an MJCF file, see MakeChainRobot; the root is
// "world", gravity the file's. Strict, as ReadUrdf is. Default classes, all
// orientations, inertia of primitive geoms and several joints in a body are
// read as MuJoCo reads them; ball and free joints on the chain, <include>, what
// MuJoCo makes bodies from and what its compiler would change are refused.
// Noted and not used: springs, tendons, equalities, gravcomp. Throws
// InputError.
Robot ReadMjcf(const Document& file, const RobotReaderOptions& options);

}  // namespace armcal

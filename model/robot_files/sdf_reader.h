#pragma once

#include "model/robot/robot.h"
#include "model/robot_tree/robot_reader_options.h"
#include "model/text/document.h"

namespace armcal {

// Reads the chain base..tip of the only model of an SDF file, see
// MakeTreeRobot: links, revolute, continuous, prismatic and fixed joints,
// frames. A joint whose child another joint moves already closes a loop. The
// root is "world" where a joint fixes the model to it. Strict, as ReadUrdf is;
// other files (<include>), nested models and several models are refused.
// Gravity is the <world>'s, whose default is 0 0 -9.8; without a world 0 0
// -9.81. Throws InputError.
Robot ReadSdf(const Document& file, const RobotReaderOptions& options);

}  // namespace armcal

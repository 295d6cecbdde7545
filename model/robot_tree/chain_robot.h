#pragma once

#include <string>

#include "model/robot/robot.h"
#include "model/robot_tree/robot_reader_options.h"
#include "model/robot_tree/robot_tree.h"

namespace armcal {

// The robot of the chain base..tip that the options choose from the tree of the
// file `path`. Fixed joints are lumped: their child's inertia moves to the link
// they are fixed to (also links fixed to the chain that lie beside it), links
// beside the chain that move are dropped; Robot::notes says which. Inertia of
// links fixed to the base is ignored. The tool frame is the tip that the
// options name or the only fixed leaf beyond the last joint, else the last
// link's frame. Throws InputError.
Robot MakeChainRobot(const std::string& path, const RobotTree& tree,
                     const RobotReaderOptions& options);

}  // namespace armcal

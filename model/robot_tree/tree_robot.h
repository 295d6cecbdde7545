#pragma once

#include <string>

#include "model/robot/robot.h"
#include "model/robot_tree/robot_reader_options.h"
#include "model/robot_tree/robot_tree.h"

namespace armcal {

// The robot that moves from the base to the tips which the options choose in
// the tree of the file `path`. Fixed joints are lumped: their child's inertia
// moves to the link they are fixed to. So are joints that move something beside
// it, held at a posture; Robot::notes says which. Inertia of what does not move
// is ignored. The tool frame, on the last link, is the tip that the options
// name there or the only fixed leaf beyond the last joint, else the last link's
// frame. Throws InputError.
Robot MakeTreeRobot(const std::string& path, const RobotTree& file,
                    const RobotReaderOptions& options);

}  // namespace armcal

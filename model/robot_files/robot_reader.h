#pragma once

#include "model/robot/robot.h"
#include "model/robot_tree/robot_reader_options.h"
#include "model/text/document.h"

namespace armcal {

// By the ending, .yaml or .yml; of .urdf, .xml, .mjcf and .sdf by the root
// element.
enum class RobotFileKind { kUrdf, kMjcf, kSdf, kYaml };
RobotFileKind KindOfRobotFile(const Document& file);

// Reads a robot file of any kind. Throws InputError with file, line and
// element, value and expectation; also where finite numbers of the file have
// products that are not.
Robot ReadRobot(const Document& file, const RobotReaderOptions& options);

}  // namespace armcal

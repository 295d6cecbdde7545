#include "model/robot_files/urdf_reader.h"

#include "model/robot_files/urdf_tree.h"
#include "model/robot_tree/tree_robot.h"

namespace armcal {

Robot ReadUrdf(const Document& file, const RobotReaderOptions& options) {
  return MakeTreeRobot(file.name(), ReadUrdfTree(file), options);
}

}  // namespace armcal

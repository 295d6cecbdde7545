#include "model/robot_files/mjcf/mjcf_reader.h"

#include "model/robot_files/mjcf/mjcf_tree.h"
#include "model/robot_tree/tree_robot.h"

namespace armcal {

Robot ReadMjcf(const Document& file, const RobotReaderOptions& options) {
  return MakeTreeRobot(file.name(), ReadMjcfTree(file, options.folder),
                       options);
}

}  // namespace armcal

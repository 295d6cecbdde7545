#include "model/robot_files/mjcf/mjcf_reader.h"

#include "model/robot_files/mjcf/mjcf_tree.h"
#include "model/robot_tree/chain_robot.h"

namespace armcal {

Robot ReadMjcf(const Document& file, const RobotReaderOptions& options) {
  return MakeChainRobot(file.name(), ReadMjcfTree(file, options.folder),
                        options);
}

}  // namespace armcal

#include "model/robot_files/mjcf_reader.h"

#include "model/robot_files/chain_robot.h"
#include "model/robot_files/mjcf_tree.h"

namespace armcal {

Robot ReadMjcf(const Document& file, const RobotReaderOptions& options) {
  return MakeChainRobot(file.name(), ReadMjcfTree(file, options.folder),
                        options);
}

}  // namespace armcal

#include "model/robot_files/urdf_reader.h"

#include "model/robot_files/urdf_tree.h"
#include "model/robot_tree/chain_robot.h"

namespace armcal {

Robot ReadUrdf(const Document& file, const RobotReaderOptions& options) {
  return MakeChainRobot(file.name(), ReadUrdfTree(file), options);
}

}  // namespace armcal

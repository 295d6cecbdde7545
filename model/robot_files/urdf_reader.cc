#include "model/robot_files/urdf_reader.h"

#include "model/robot_files/chain_robot.h"
#include "model/robot_files/urdf_tree.h"

namespace armcal {

Robot ReadUrdf(const std::string& path, const RobotReaderOptions& options) {
  return MakeChainRobot(path, ReadUrdfTree(path), options);
}

}  // namespace armcal

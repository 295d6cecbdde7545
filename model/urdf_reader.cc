#include "model/urdf_reader.h"

#include "model/chain_robot.h"
#include "model/urdf_tree.h"

namespace armcal {

Robot ReadUrdf(const std::string& path, const RobotReaderOptions& options) {
  return MakeChainRobot(path, ReadUrdfTree(path), options);
}

}  // namespace armcal

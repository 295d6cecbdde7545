#include "model/mjcf_reader.h"

#include "model/chain_robot.h"
#include "model/mjcf_tree.h"

namespace armcal {

Robot ReadMjcf(const std::string& path, const RobotReaderOptions& options) {
  return MakeChainRobot(path, ReadMjcfTree(path), options);
}

}  // namespace armcal

#include "model/robot_files/mjcf_reader.h"

#include "model/robot_files/chain_robot.h"
#include "model/robot_files/mjcf_tree.h"

namespace armcal {

Robot ReadMjcf(const std::string& path, const RobotReaderOptions& options) {
  return MakeChainRobot(path, ReadMjcfTree(path), options);
}

}  // namespace armcal

#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>

#include "model/robot.h"

namespace armcal {

struct RobotReaderOptions {
  // Not for YAML: the chain from link `base` to link `tip`. Empty: the root,
  // and the only leaf that is moved by a joint; several such leaves are refused
  // with a message that lists them.
  std::string base;
  std::string tip;
  // Overrides the file's gravity vector, in the base link's frame, m/s^2. URDF
  // has none: 0 0 -9.81 in the root link's frame. It is turned by the fixed
  // joints between root and base.
  std::optional<Eigen::Vector3d> gravity;
};

// By the ending, .yaml or .yml; of .urdf, .xml and .mjcf by the root element.
enum class RobotFileKind { kUrdf, kMjcf, kYaml };
RobotFileKind KindOfRobotFile(const std::string& path);

// Reads a robot file of any kind. Throws InputError with file, line and
// element, value and expectation; also where finite numbers of the file have
// products that are not.
Robot ReadRobot(const std::string& path, const RobotReaderOptions& options);

}  // namespace armcal

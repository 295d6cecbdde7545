#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>

#include "model/robot.h"

namespace armcal {

struct RobotReaderOptions {
  // URDF only: the chain from link `base` to link `tip`. Empty: the root, and
  // the only leaf that is moved by a joint; several such leaves are refused
  // with a message that lists them.
  std::string base;
  std::string tip;
  // Overrides the file's gravity vector, in the base link's frame, m/s^2. URDF
  // has none: 0 0 -9.81 in the root link's frame, turned by the fixed joints
  // between root and base.
  std::optional<Eigen::Vector3d> gravity;
};

// Reads a robot file by its ending: .urdf or .xml is URDF, .yaml or .yml a DH
// table. Throws InputError with file, line and element, value and expectation;
// also where finite numbers of the file have products that are not.
Robot ReadRobot(const std::string& path, const RobotReaderOptions& options);

}  // namespace armcal

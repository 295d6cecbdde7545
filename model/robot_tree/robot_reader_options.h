#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>

namespace armcal {

struct RobotReaderOptions {
  // Not for YAML: the chain from link `base` to link `tip`. Empty: the root,
  // and the only leaf that is moved by a joint; several such leaves are refused
  // with a message that lists them.
  std::string base;
  std::string tip;
  // MJCF: the folder within which files that the robot's file includes, and
  // meshes that give inertia, must lie. Empty: the folder of the robot's file,
  // with those in it.
  std::string folder;
  // Overrides the file's gravity vector, in the base link's frame, m/s^2. URDF
  // has none: 0 0 -9.81 in the root link's frame. It is turned by the fixed
  // joints between root and base.
  std::optional<Eigen::Vector3d> gravity;
};

}  // namespace armcal

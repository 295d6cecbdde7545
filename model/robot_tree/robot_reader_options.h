#pragma once

#include <Eigen/Core>
#include <map>
#include <optional>
#include <string>

namespace armcal {

struct RobotReaderOptions {
  // Not for YAML: what moves from link `base` to link `tip`, or to several with
  // commas between: "left_hand,right_hand". Empty: the root, and the only leaf
  // that is moved by a joint; several such leaves are refused with a message
  // that lists them.
  std::string base;
  std::string tip;
  // Where joints are held that move something beside these, by their names, rad
  // or m; others next to 0.
  std::map<std::string, double> posture;
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

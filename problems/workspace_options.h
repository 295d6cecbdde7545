#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

namespace armcal {

// Axis-aligned in W, m.
struct Box {
  Eigen::Vector3d low, high;
};

// What an arm must keep clear of. All in W, m.
struct WorkspaceOptions {
  std::optional<Box> tool_box;  // that the tool's point stays in
  std::optional<double> floor;  // height against gravity (along z without)
  std::vector<Box> obstacles;
  double link_radius = .06;  // of the balls that stand for links

  bool empty() const { return !tool_box && !floor && obstacles.empty(); }
};

}  // namespace armcal

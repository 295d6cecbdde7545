#pragma once

#include <optional>
#include <string>
#include <vector>

#include "model/urdf_elements.h"

namespace armcal {

// What a URDF file says, before a chain is chosen.
struct UrdfTree {
  std::string name;
  std::vector<UrdfLink> links;
  std::vector<UrdfJoint> joints;
  std::vector<int> roots;  // links without a parent joint, at least one

  std::optional<int> FindLink(const std::string& name) const;
};

// Reads every link and joint of the file and ties them to trees: each link has
// at most one parent joint and there are no loops. Throws InputError.
UrdfTree ReadUrdfTree(const std::string& path);

}  // namespace armcal

#pragma once

#include <Eigen/Geometry>
#include <functional>
#include <string>
#include <vector>

#include "model/robot_tree/robot_tree.h"

namespace armcal {

// A way through the tree of a robot file; links and joints by index.
struct RobotChain {
  int base = -1;
  int tip = -1;
  std::vector<int> joints;  // base to tip, the fixed ones left out; at least 1
};

// Chooses the chain between two links. An empty `base` is the only root, an
// empty `tip` the only moved link beyond which nothing moves; where there are
// several, where the links are unknown or not connected by joints that armcal
// can handle, it throws InputError.
RobotChain ChooseChain(const std::string& path, const RobotTree& tree,
                       const std::string& base, const std::string& tip);

// A link (the head) and all that fixed joints attach to it further out.
struct RigidGroup {
  std::vector<int> links;  // the head first
  std::vector<Eigen::Isometry3d>
      X_HLs;                // poses of these links in the head's frame
  std::vector<int> joints;  // the joints that leave the group, not fixed
};

RigidGroup FindGroup(const RobotTree& tree, int head);
Eigen::Isometry3d PoseInGroup(const RigidGroup& group, int link);

// Visits the groups that joints move beyond the link `base`, near ones first.
void VisitMovedGroups(
    const RobotTree& tree, int base,
    const std::function<void(int head, const RigidGroup&)>& visit);

}  // namespace armcal

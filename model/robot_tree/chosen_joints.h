#pragma once

#include <Eigen/Geometry>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "model/robot/link_paths.h"
#include "model/robot_tree/robot_tree.h"

namespace armcal {

// The part of the tree of a robot file that moves from a base to one or several
// tips; links and joints by index.
struct ChosenJoints {
  int base = -1;
  std::vector<int> tips;    // at least one, in the order that they were named
  std::vector<int> joints;  // base to tips, the fixed ones left out; at least 1
  LinkParents parents;      // as Robot's, of places in `joints`
};

// Chooses the joints between link `base` and the links of `tip`, names with
// commas between. An empty `base` is the only root, an empty `tip` the only
// moved link beyond which nothing moves; where there are several, where the
// links are unknown or not connected by joints that armcal can handle, it
// throws InputError.
ChosenJoints ChooseJoints(const std::string& path, const RobotTree& tree,
                          const std::string& base, const std::string& tip);

// Makes the supported joints that are not chosen but move something beside the
// chosen ones fixed, at the position that `posture` has for their names or at
// the one next to 0 that their limits allow. Returns where each is. What is
// wrong beyond them is left out with them. Throws InputError where `posture`
// names a joint that is none of these, or a position beyond its limits.
std::map<std::string, double> HoldOtherJoints(
    const std::string& path, const ChosenJoints& chosen,
    const std::map<std::string, double>& posture, RobotTree* tree);

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

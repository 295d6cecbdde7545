#include "model/robot_files/robot_chain.h"

#include <algorithm>

#include "model/text/input_error.h"
#include "model/text/input_text.h"
#include "model/text/option_name.h"

namespace armcal {
namespace {

using Eigen::Isometry3d;

constexpr int kMaxJoints = 64;

int RequireLink(const std::string& path, const RobotTree& tree,
                const std::string& option, const std::string& name) {
  const std::optional<int> link = tree.FindLink(name);
  if (link) return *link;
  throw InputError(path, OptionName(option), OneLine(name),
                   "expected one of the links " + LinkNames(tree.links));
}

int ChooseBase(const std::string& path, const RobotTree& tree,
               const std::string& base) {
  if (!base.empty()) return RequireLink(path, tree, "base", base);
  if (tree.roots.size() == 1) return tree.roots.front();
  std::vector<std::string> names;
  for (const int root : tree.roots) names.push_back(tree.links[root].name);
  throw InputError(
      path, "", JoinNames(names),
      "expected one root link: choose one with " + OptionName("base"));
}

int ChooseTip(const std::string& path, const RobotTree& tree, int base,
              const std::string& tip) {
  if (!tip.empty()) return RequireLink(path, tree, "tip", tip);
  std::vector<int> leaves;
  std::vector<std::string> names;
  VisitMovedGroups(tree, base, [&](int head, const RigidGroup& group) {
    if (!group.joints.empty()) return;
    leaves.push_back(head);
    names.push_back(tree.links[head].name);
  });
  if (leaves.empty()) {
    throw InputError(path, "", "",
                     "expected a joint that moves a link of base link " +
                         Quoted(tree.links[base].name));
  }
  if (leaves.size() > 1) {
    throw InputError(
        path, "", JoinNames(names),
        "expected one chain: choose its last link with " + OptionName("tip"));
  }
  return leaves.front();
}

void RequireUsable(const std::string& path, const RobotTree& tree,
                   const TreeJoint& joint) {
  const std::string place = "line " + std::to_string(joint.line) + ", joint " +
                            Quoted(joint.joint.name);
  if (!joint.is_supported) {
    throw InputError(path, place, joint.type,
                     "expected " + tree.joint_types + " in the chain; " +
                         OptionName("base") + "=" +
                         OneLine(tree.links[joint.child].name) +
                         " starts behind it");
  }
  if (joint.is_mimic) {
    throw InputError(path, place, "mimic",
                     "expected joints that move on their own in the chain; end "
                     "it before with " +
                         OptionName("tip"));
  }
}

// The moving joints from base to tip.
std::vector<int> FindChain(const std::string& path, const RobotTree& tree,
                           int base, int tip) {
  std::vector<int> chain;
  for (int link = tip; link != base;) {
    const int j = tree.links[link].parent_joint;
    if (j < 0) {
      throw InputError(path, OptionName("tip"), OneLine(tree.links[tip].name),
                       "expected a link that joints connect to the base link " +
                           Quoted(tree.links[base].name));
    }
    if (!tree.joints[j].is_fixed) chain.push_back(j);
    link = tree.joints[j].parent;
  }
  std::reverse(chain.begin(), chain.end());
  if (chain.empty()) {
    throw InputError(path, OptionName("tip"), OneLine(tree.links[tip].name),
                     "expected a link that a joint moves relative to " +
                         Quoted(tree.links[base].name));
  }
  for (const int j : chain) RequireUsable(path, tree, tree.joints[j]);
  if (chain.size() > kMaxJoints) {
    throw InputError(path, "", std::to_string(chain.size()) + " joints",
                     "expected at most " + std::to_string(kMaxJoints) +
                         " moving joints in the chain");
  }
  return chain;
}

}  // namespace

RigidGroup FindGroup(const RobotTree& tree, int head) {
  RigidGroup group{{head}, {Isometry3d::Identity()}, {}};
  for (size_t i = 0; i < group.links.size(); ++i) {
    for (const int j : tree.links[group.links[i]].child_joints) {
      const TreeJoint& joint = tree.joints[j];
      if (joint.is_fixed) {
        group.links.push_back(joint.child);
        group.X_HLs.push_back(group.X_HLs[i] * joint.X_PJ * joint.X_JL);
      } else {
        group.joints.push_back(j);
      }
    }
  }
  return group;
}

Isometry3d PoseInGroup(const RigidGroup& group, int link) {
  const auto at = std::find(group.links.begin(), group.links.end(), link);
  return group.X_HLs[at - group.links.begin()];
}

void VisitMovedGroups(
    const RobotTree& tree, int base,
    const std::function<void(int head, const RigidGroup&)>& visit) {
  std::vector<int> open = {base};
  while (!open.empty()) {
    const int head = open.back();
    open.pop_back();
    const RigidGroup group = FindGroup(tree, head);
    if (head != base) visit(head, group);
    for (auto j = group.joints.rbegin(); j != group.joints.rend(); ++j) {
      open.push_back(tree.joints[*j].child);
    }
  }
}

RobotChain ChooseChain(const std::string& path, const RobotTree& tree,
                       const std::string& base, const std::string& tip) {
  RobotChain chain;
  chain.base = ChooseBase(path, tree, base);
  chain.tip = ChooseTip(path, tree, chain.base, tip);
  chain.joints = FindChain(path, tree, chain.base, chain.tip);
  return chain;
}

}  // namespace armcal

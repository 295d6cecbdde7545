#include "model/robot_tree/robot_chain.h"

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

// Where the ways to several tips part: what they share may be all that is
// wanted.
std::string SharedChain(const RobotTree& tree, int base) {
  int link = base, count = 0;
  RigidGroup group = FindGroup(tree, base);
  for (; group.joints.size() == 1; ++count) {
    link = tree.joints[group.joints.front()].child;
    group = FindGroup(tree, link);
  }
  if (count == 0) return "";
  const std::string name = OneLine(tree.links[link].name);
  return ". It branches at " + Quoted(name) + ": " + OptionName("tip") + "=" +
         name + " has the " +
         (count == 1 ? "joint" : std::to_string(count) + " joints") +
         " that all share";
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
    throw InputError(path, "", JoinNames(names),
                     "expected one chain: choose its last link with " +
                         OptionName("tip") +
                         "; links that move beside the chain are left out" +
                         SharedChain(tree, base));
  }
  return leaves.front();
}

void RequireUsable(const std::string& path, const RobotTree& tree,
                   const TreeJoint& joint) {
  if (joint.error) throw InputError(*joint.error);
  if (joint.is_supported) return;
  throw InputError(
      path,
      "line " + std::to_string(joint.line) + ", joint " +
          Quoted(joint.joint.name),
      joint.type,
      "expected " + tree.joint_types + " in the chain; " + OptionName("base") +
          "=" + OneLine(tree.links[joint.child].name) + " starts behind it");
}

// Refuses a chain with joints that a coupling ties to others: fitted as an open
// chain, their torques and bodies would be taken for what they are not.
void RequireUncoupled(const std::string& path, const RobotTree& tree,
                      const TreeCoupling& coupling,
                      const std::vector<int>& chain) {
  const auto is_tied = [&](int j) {
    const auto& tied = coupling.joints;
    return std::find(tied.begin(), tied.end(), j) != tied.end();
  };
  const auto first = std::find_if(chain.begin(), chain.end(), is_tied);
  if (first == chain.end()) return;
  const auto last = std::find_if(chain.rbegin(), chain.rend(), is_tied).base();
  std::vector<std::string> names;
  for (const int j : chain) {
    if (is_tied(j)) names.push_back(tree.joints[j].joint.name);
  }
  std::string remedy;
  if (first != chain.begin()) {
    remedy += OptionName("tip") + "=" +
              OneLine(tree.links[tree.joints[*first].parent].name) +
              " ends it before them, ";
  }
  if (last != chain.end()) {
    remedy += OptionName("base") + "=" +
              OneLine(tree.links[tree.joints[last[-1]].child].name) +
              " starts it behind them, ";
  }
  throw InputError(path, coupling.what, JoinNames(names),
                   "expected joints that move on their own in the chain: "
                   "armcal's arms are open chains; " +
                       remedy +
                       "and where the real robot has no such part, take it out "
                       "of the file");
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
  for (const TreeCoupling& coupling : tree.couplings) {
    RequireUncoupled(path, tree, coupling, chain);
  }
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

#include "model/robot_tree/chosen_joints.h"

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

std::vector<std::string> SplitNames(const std::string& names) {
  std::vector<std::string> parts;
  for (size_t begin = 0; begin <= names.size();) {
    const size_t end = std::min(names.find(',', begin), names.size());
    parts.push_back(names.substr(begin, end - begin));
    begin = end + 1;
  }
  return parts;
}

std::vector<int> ChooseTips(const std::string& path, const RobotTree& tree,
                            int base, const std::string& tip) {
  std::vector<int> tips;
  if (tree.FindLink(tip)) return {RequireLink(path, tree, "tip", tip)};
  for (const std::string& name : SplitNames(tip)) {
    if (tip.empty()) break;
    tips.push_back(RequireLink(path, tree, "tip", name));
  }
  if (!tips.empty()) return tips;
  std::vector<std::string> names;
  VisitMovedGroups(tree, base, [&](int head, const RigidGroup& group) {
    if (!group.joints.empty()) return;
    tips.push_back(head);
    names.push_back(tree.links[head].name);
  });
  if (tips.empty()) {
    throw InputError(path, "", "",
                     "expected a joint that moves a link of base link " +
                         Quoted(tree.links[base].name));
  }
  if (tips.size() > 1) {
    throw InputError(path, "", JoinNames(names),
                     "expected one chain: choose its last link with " +
                         OptionName("tip") + ", or several, as in " +
                         OptionName("tip") + "=" + OneLine(names[0]) + "," +
                         OneLine(names[1]) +
                         "; what other joints move counts as held still (" +
                         OptionName("posture") + ")" + SharedChain(tree, base));
  }
  return tips;
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
  return chain;
}

// The chains to the tips, each joint once and depth first: what sits on a link
// in the order in which tips lead there.
void Merge(const RobotTree& tree, const std::vector<std::vector<int>>& chains,
           ChosenJoints* chosen) {
  std::vector<std::vector<int>> on(tree.joints.size() + 1);  // last: the base
  const auto add = [](std::vector<int>* joints, int j) {
    if (std::count(joints->begin(), joints->end(), j) == 0)
      joints->push_back(j);
  };
  for (const std::vector<int>& chain : chains) {
    size_t before = tree.joints.size();
    for (const int j : chain) {
      add(&on[before], j);
      before = j;
    }
  }
  struct Open {
    int joint, parent;
  };
  std::vector<Open> open;
  const auto open_all = [&](size_t joint, int parent) {
    for (auto j = on[joint].rbegin(); j != on[joint].rend(); ++j) {
      open.push_back({*j, parent});
    }
  };
  open_all(tree.joints.size(), -1);
  bool branches = false;
  while (!open.empty()) {
    const Open next = open.back();
    open.pop_back();
    const auto place = static_cast<int>(chosen->joints.size());
    branches |= next.parent != place - 1;
    chosen->joints.push_back(next.joint);
    chosen->parents.push_back(next.parent);
    open_all(next.joint, place);
  }
  if (!branches) chosen->parents.clear();
}

// The joint's pose with it at q.
Isometry3d HeldPose(const TreeJoint& joint, double q) {
  if (!IsRotational(joint.joint.type)) {
    return joint.X_PJ * Eigen::Translation3d(q * joint.axis);
  }
  return joint.X_PJ * Isometry3d(Eigen::AngleAxisd(q, joint.axis));
}

// Where a joint is held: where the user says; where it follows another, as that
// is held; else next to 0.
double HeldPosition(const RobotTree& tree, const TreeJoint& joint,
                    const std::map<std::string, double>& posture,
                    int leaders = 0) {
  constexpr int kMostLeaders = 8;  // joints that follow each other in a circle
  const auto said = posture.find(joint.joint.name);
  if (said != posture.end()) return said->second;
  if (!joint.mimic || leaders == kMostLeaders) {
    return std::clamp(0., joint.joint.lower, joint.joint.upper);
  }
  return joint.mimic->offset +
         joint.mimic->factor * HeldPosition(tree,
                                            tree.joints[joint.mimic->leader],
                                            posture, leaders + 1);
}

// Leaves out what is wrong beyond the link, which a joint that is held moves.
void LeaveOutWrong(int head, RobotTree* tree) {
  std::vector<int> open = {head};
  while (!open.empty()) {
    TreeLink& link = tree->links[open.back()];
    open.pop_back();
    if (link.is_held) continue;
    link.is_held = true;
    auto& joints = link.child_joints;
    joints.erase(std::remove_if(joints.begin(), joints.end(),
                                [tree](int j) {
                                  const TreeJoint& joint = tree->joints[j];
                                  return joint.is_fixed && joint.error;
                                }),
                 joints.end());
    for (const int j : joints) {
      if (tree->joints[j].is_fixed) open.push_back(tree->joints[j].child);
    }
  }
}

void RequirePosture(const std::string& path, const RobotTree& tree,
                    const std::vector<int>& held,
                    const std::map<std::string, double>& posture) {
  std::vector<std::string> names;
  for (const int j : held) names.push_back(tree.joints[j].joint.name);
  for (const auto& [name, q] : posture) {
    const auto at = std::find(names.begin(), names.end(), name);
    if (at == names.end()) {
      throw InputError(
          path, OptionName("posture"), OneLine(name),
          names.empty()
              ? "expected none: no joint moves anything beside the robot's own"
              : "expected a joint that moves something beside the robot's "
                "own: " +
                    JoinNames(names));
    }
    const Joint& joint = tree.joints[held[at - names.begin()]].joint;
    constexpr double kRounding = 1e-6;
    if (q >= joint.lower - kRounding && q <= joint.upper + kRounding) continue;
    throw InputError(
        path, OptionName("posture"), OneLine(name) + "=" + NumberText(q),
        "expected a position within the joint's limits, " +
            NumberText(joint.lower) + " to " + NumberText(joint.upper) + " " +
            PositionUnit(joint.type));
  }
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

ChosenJoints ChooseJoints(const std::string& path, const RobotTree& tree,
                          const std::string& base, const std::string& tip) {
  ChosenJoints chosen;
  chosen.base = ChooseBase(path, tree, base);
  chosen.tips = ChooseTips(path, tree, chosen.base, tip);
  std::vector<std::vector<int>> chains;
  for (const int link : chosen.tips) {
    chains.push_back(FindChain(path, tree, chosen.base, link));
  }
  Merge(tree, chains, &chosen);
  if (chosen.joints.size() > kMaxJoints) {
    throw InputError(path, "", std::to_string(chosen.joints.size()) + " joints",
                     "expected at most " + std::to_string(kMaxJoints) +
                         " moving joints in the chain");
  }
  return chosen;
}

std::map<std::string, double> HoldOtherJoints(
    const std::string& path, const ChosenJoints& chosen,
    const std::map<std::string, double>& posture, RobotTree* tree) {
  std::vector<int> held;
  std::vector<int> open = {chosen.base};
  while (!open.empty()) {
    const RigidGroup group = FindGroup(*tree, open.back());
    open.pop_back();
    for (const int j : group.joints) {
      const TreeJoint& joint = tree->joints[j];
      const bool is_chosen =
          std::count(chosen.joints.begin(), chosen.joints.end(), j) > 0;
      if (!is_chosen && (!joint.is_supported || joint.error)) continue;
      if (!is_chosen) held.push_back(j);
      open.push_back(joint.child);
    }
  }
  RequirePosture(path, *tree, held, posture);
  std::map<std::string, double> positions;
  for (const int j : held) {
    TreeJoint& joint = tree->joints[j];
    const double q = HeldPosition(*tree, joint, posture);
    joint.X_PJ = HeldPose(joint, q);
    joint.is_fixed = true;
    positions[joint.joint.name] = q;
  }
  for (const int j : held) LeaveOutWrong(tree->joints[j].child, tree);
  return positions;
}

}  // namespace armcal

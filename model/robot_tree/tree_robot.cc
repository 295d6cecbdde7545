#include "model/robot_tree/tree_robot.h"

#include <algorithm>
#include <set>

#include "model/robot/axis_rotation.h"
#include "model/robot_tree/chosen_joints.h"
#include "model/text/input_text.h"
#include "model/text/option_name.h"

namespace armcal {
namespace {

using Eigen::Isometry3d;
using Eigen::Matrix3d;
using Eigen::Vector3d;

// Refuses a fixed joint that was not read: where its link stands is unknown.
void RequirePose(const RobotTree& tree, int link) {
  const TreeJoint& joint = tree.joints[tree.links[link].parent_joint];
  if (joint.error) throw InputError(*joint.error);
}

// The links that fixed joints put between the group's head and `link`.
void RequirePoses(const RobotTree& tree, const RigidGroup& group, int link) {
  for (; link != group.links.front();
       link = tree.joints[tree.links[link].parent_joint].parent) {
    RequirePose(tree, link);
  }
}

// What the file says that was not read, as the robot has no use for it.
void NoteUnread(const RobotTree& tree, const std::set<int>& used,
                std::vector<std::string>* notes) {
  constexpr size_t kMost = 5;
  std::vector<std::string> unread;
  for (size_t i = 0; i < tree.links.size(); ++i) {
    const TreeLink& link = tree.links[i];
    if (used.count(static_cast<int>(i)) > 0) continue;
    if (link.error) unread.push_back(link.error->what());
    if (link.parent_joint < 0) continue;
    const auto& error = tree.joints[link.parent_joint].error;
    if (error) unread.push_back(error->what());
  }
  for (size_t i = 0; i < std::min(unread.size(), kMost); ++i) {
    notes->push_back("not read, as it lies outside the chain: " + unread[i]);
  }
  if (unread.size() > kMost) {
    notes->push_back(
        "not read either: " + std::to_string(unread.size() - kMost) +
        " more elements outside the chain");
  }
}

// Loops and the like over other joints than the chain's, which has been asked;
// but for joints that follow others and are held.
void NoteCouplings(const RobotTree& tree, Robot* robot) {
  constexpr size_t kMost = 5;
  std::vector<std::string>* const notes = &robot->notes;
  size_t count = 0;
  for (const TreeCoupling& coupling : tree.couplings) {
    const bool held =
        std::all_of(coupling.joints.begin(), coupling.joints.end(), [&](int j) {
          return robot->held.count(tree.joints[j].joint.name) > 0;
        });
    if (held && !coupling.joints.empty() &&
        tree.joints[coupling.joints.front()].mimic) {
      continue;  // it stands where the other puts it
    }
    if (++count > kMost) continue;
    notes->push_back("not used, as it lies outside the chain: " +
                     coupling.what);
  }
  if (count > kMost) {
    notes->push_back("not used either: " + std::to_string(count - kMost) +
                     " more that tie joints outside the chain");
  }
}

// The link that `j` moves: joint frames and the lumped inertia of its group.
Link MakeLink(const RobotTree& tree, int j, const RigidGroup& before,
              const RigidGroup& group) {
  const TreeJoint& joint = tree.joints[j];
  const Matrix3d R = RotationOntoAxis(joint.axis);
  Link link;
  link.name = tree.links[joint.child].name;
  link.joint = joint.joint;
  link.X_PF = PoseInGroup(before, joint.parent) * joint.X_PJ * Isometry3d(R);
  link.X_ML = Isometry3d(R.transpose()) * joint.X_JL;
  for (size_t i = 0; i < group.links.size(); ++i) {
    const TreeLink& part = tree.links[group.links[i]];
    if (part.error && part.is_held) continue;
    if (part.error) throw InputError(*part.error);
    if (i > 0) RequirePose(tree, group.links[i]);
    if (!part.has_inertial) continue;
    link.inertial += part.inertial.ReexpressIn(group.X_HLs[i]);
    link.has_inertial = true;
  }
  // Moments alone are no body's.
  if (link.inertial.mass == 0) {
    link.inertial = InertialParameters();
    link.has_inertial = false;
    if (tree.links[joint.child].is_massless) DeclareMassless(&link);
  }
  return link;
}

void NoteGroup(const RobotTree& tree, const RigidGroup& group, bool is_base,
               std::vector<std::string>* notes) {
  std::vector<std::string> fixed, held, massive;
  for (size_t i = 0; i < group.links.size(); ++i) {
    const TreeLink& part = tree.links[group.links[i]];
    if (i > 0 && !part.is_frame) {
      (part.is_held ? held : fixed).push_back(part.name);
    }
    if (part.has_inertial) massive.push_back(part.name);
    if (is_base) continue;
    notes->insert(notes->end(), part.notes.begin(), part.notes.end());
  }
  const std::string head = Quoted(tree.links[group.links[0]].name);
  if (is_base && !massive.empty()) {
    notes->push_back("not used, as they do not move: the inertia of " +
                     JoinNames(massive));
  }
  if (!is_base && !fixed.empty()) {
    notes->push_back("lumped into link " + head +
                     " by fixed joints: " + JoinNames(fixed));
  }
  if (!is_base && !held.empty()) {
    notes->push_back("lumped into link " + head +
                     " by joints that are held: " + JoinNames(held));
  }
}

// Names the links beyond joints that are neither the robot's nor held.
void NoteDropped(const RobotTree& tree, const RigidGroup& group,
                 const std::vector<int>& chosen,
                 std::vector<std::string>* notes) {
  for (const int j : group.joints) {
    if (std::count(chosen.begin(), chosen.end(), j) > 0) continue;
    const int head = tree.joints[j].child;
    std::vector<std::string> names;
    const auto add = [&](const RigidGroup& dropped) {
      for (const int link : dropped.links) {
        names.push_back(tree.links[link].name);
      }
    };
    add(FindGroup(tree, head));
    VisitMovedGroups(tree, head,
                     [&](int, const RigidGroup& beyond) { add(beyond); });
    notes->push_back("dropped, as joint " + Quoted(tree.joints[j].joint.name) +
                     " cannot be held: " + JoinNames(names));
  }
}

// What nothing stands on of the group's links, but for its head: of links that
// are bodies, or where there are none, of frames.
std::vector<int> FixedLeaves(const RobotTree& tree, const RigidGroup& group) {
  std::vector<int> bodies, frames;
  for (const int link : group.links) {
    const TreeLink& part = tree.links[link];
    const bool carries = std::any_of(
        part.child_joints.begin(), part.child_joints.end(),
        [&](int j) { return !tree.links[tree.joints[j].child].is_frame; });
    if (carries || part.is_held || link == group.links.front()) continue;
    (part.is_frame ? frames : bodies).push_back(link);
  }
  return bodies.empty() ? frames : bodies;
}

// The tool frame: the tip the user names, else the only fixed leaf there is.
void SetTool(const RobotTree& tree, const RigidGroup& last,
             const std::optional<int>& named_tip, Robot* robot) {
  const std::vector<int> leaves = FixedLeaves(tree, last);
  int tool = last.links.front();
  if (named_tip) {
    tool = *named_tip;
  } else if (leaves.size() == 1) {
    tool = leaves.front();
  }
  if (tool == last.links.front()) return;
  robot->tool_name = tree.links[tool].name;
  robot->X_LT = PoseInGroup(last, tool);
}

void NoteHeld(const RobotTree& tree, Robot* robot) {
  std::vector<std::string> held;
  for (const TreeJoint& joint : tree.joints) {
    const auto at = robot->held.find(joint.joint.name);
    if (at == robot->held.end()) continue;
    held.push_back(at->first + " at " + NumberText(at->second) + " " +
                   PositionUnit(joint.joint.type));
  }
  if (held.empty()) return;
  robot->notes.push_back("joints held still, with what they move (" +
                         OptionName("posture") + "): " + JoinNames(held));
}

// The last link that the user names a tip and that moves with the last joint.
std::optional<int> ToolOf(const ChosenJoints& chosen, const RigidGroup& last) {
  for (auto tip = chosen.tips.rbegin(); tip != chosen.tips.rend(); ++tip) {
    if (std::count(last.links.begin(), last.links.end(), *tip) > 0) return *tip;
  }
  return std::nullopt;
}

std::string GravityText(const Vector3d& g) {
  return NumberText(g[0]) + " " + NumberText(g[1]) + " " + NumberText(g[2]) +
         " m/s^2";
}

// Gravity of the root's frame, turned into the base link's. A joint above the
// base may turn it anywhere; then the base link's axes are taken as the root's.
void TurnGravity(const RobotTree& tree, int base, Robot* robot) {
  Matrix3d R_RootBase = Matrix3d::Identity();
  for (int link = base; tree.links[link].parent_joint >= 0;) {
    const TreeJoint& joint = tree.joints[tree.links[link].parent_joint];
    if (!joint.is_fixed) {
      robot->notes.push_back("gravity is taken as " +
                             GravityText(robot->gravity) +
                             " in the base link's frame, which joint " +
                             Quoted(joint.joint.name) + " moves");
      return;
    }
    R_RootBase = joint.X_PJ.linear() * joint.X_JL.linear() * R_RootBase;
    link = joint.parent;
  }
  const Vector3d turned = R_RootBase.transpose() * robot->gravity;
  if ((turned - robot->gravity).norm() < 1e-9) return;
  robot->gravity = turned;
  robot->notes.push_back("gravity in the base link's frame is " +
                         GravityText(turned) + ", as fixed joints turn it");
}

}  // namespace

Robot MakeTreeRobot(const std::string& path, const RobotTree& file,
                    const RobotReaderOptions& options) {
  const ChosenJoints chosen =
      ChooseJoints(path, file, options.base, options.tip);
  RobotTree tree = file;
  Robot robot;
  robot.held = HoldOtherJoints(path, chosen, options.posture, &tree);
  robot.name = tree.name;
  robot.notes = tree.notes;
  robot.gravity = tree.gravity;
  robot.parents = chosen.parents;
  const RigidGroup base = FindGroup(tree, chosen.base);
  NoteGroup(tree, base, true, &robot.notes);
  NoteDropped(tree, base, chosen.joints, &robot.notes);
  std::set<int> used;
  std::vector<RigidGroup> groups;
  for (const int j : chosen.joints) {
    const int parent = robot.parent(robot.num_joints());
    const RigidGroup before = parent < 0 ? base : groups[parent];
    RequirePoses(tree, before, tree.joints[j].parent);
    const RigidGroup group = FindGroup(tree, tree.joints[j].child);
    const auto& notes = tree.joints[j].notes;
    robot.notes.insert(robot.notes.end(), notes.begin(), notes.end());
    NoteGroup(tree, group, false, &robot.notes);
    NoteDropped(tree, group, chosen.joints, &robot.notes);
    robot.links.push_back(MakeLink(tree, j, before, group));
    for (const int link : group.links) {
      if (!tree.links[link].error) used.insert(link);
    }
    groups.push_back(group);
  }
  NoteHeld(tree, &robot);
  NoteUnread(tree, used, &robot.notes);
  NoteCouplings(tree, &robot);
  SetTool(tree, groups.back(),
          options.tip.empty() ? std::nullopt : ToolOf(chosen, groups.back()),
          &robot);
  if (options.gravity) {
    robot.gravity = *options.gravity;
  } else {
    TurnGravity(tree, chosen.base, &robot);
  }
  return robot;
}

}  // namespace armcal

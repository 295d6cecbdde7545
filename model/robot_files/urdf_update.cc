#include "model/robot_files/urdf_update.h"

#include <tinyxml2.h>

#include <algorithm>
#include <optional>

#include "model/robot_files/inertia_split.h"
#include "model/robot_files/urdf_tree.h"
#include "model/robot_files/urdf_values.h"
#include "model/robot_tree/chosen_joints.h"
#include "model/text/format.h"
#include "model/text/input_error.h"
#include "model/text/input_text.h"

namespace armcal {
namespace {

using Eigen::Isometry3d;
using tinyxml2::XMLDocument;
using tinyxml2::XMLElement;

XMLElement* Find(XMLElement* root, const char* tag, const std::string& name) {
  for (XMLElement* e = root->FirstChildElement(tag); e != nullptr;
       e = e->NextSiblingElement(tag)) {
    const char* found = e->Attribute("name");
    if (found != nullptr && name == found) return e;
  }
  return nullptr;
}

// The links of the group beside its head that the file gives inertia, by number
// in the group: those that are fixed there, or those that held joints move.
std::vector<size_t> PartsOf(const RobotTree& tree, const RigidGroup& group,
                            bool held) {
  std::vector<size_t> parts;
  for (size_t i = 1; i < group.links.size(); ++i) {
    const TreeLink& link = tree.links[group.links[i]];
    if (link.has_inertial && !link.error && link.is_held == held) {
      parts.push_back(i);
    }
  }
  return parts;
}

// Their inertia together, about the head's origin and in its frame.
InertialParameters SumOf(const RobotTree& tree, const RigidGroup& group,
                         const std::vector<size_t>& parts) {
  InertialParameters sum;
  for (const size_t i : parts) {
    sum += tree.links[group.links[i]].inertial.ReexpressIn(group.X_HLs[i]);
  }
  return sum;
}

// What of the calibrated link the file cannot have as it is. Empty: nothing.
std::string SplitLoss(const RobotTree& tree, const RigidGroup& group,
                      const InertialParameters& left, const InertiaSplit& split,
                      const std::vector<size_t>& held) {
  const std::string head = tree.links[group.links.front()].name;
  const std::string why = WhyUnphysical(split.head);
  if (!why.empty()) {
    return "link " + head + " has an inertia that no body has (" + why + ")";
  }
  if (split.held_share == 1) return "";
  std::vector<std::string> names;
  for (const size_t i : held) names.push_back(tree.links[group.links[i]].name);
  return "links that held joints move (" + JoinNames(names) + ") have " +
         Format("%.3g", split.held_share) +
         " times the file's mass and inertia: beside all of it no body could "
         "be what is left of the calibrated link " +
         head + " (" + WhyUnphysical(left) + ")";
}

// The link gets what the links that are fixed to it, or held on it, do not have
// already (SplitInertia).
void DistributeInertia(const InertialParameters& total, const RobotTree& tree,
                       int head, XMLElement* root,
                       std::vector<std::string>* losses) {
  const RigidGroup group = FindGroup(tree, head);
  const auto element = [&](size_t i) {
    return Find(root, "link", tree.links[group.links[i]].name);
  };
  const std::vector<size_t> fixed = PartsOf(tree, group, false);
  const std::vector<size_t> held = PartsOf(tree, group, true);
  const InertialParameters of_held = SumOf(tree, group, held);
  const InertiaSplit split =
      SplitInertia(total, SumOf(tree, group, fixed), of_held);
  SetInertial(split.head, element(0));
  for (const size_t i : fixed) {
    if (split.fixed_keep) break;
    element(i)->DeleteChild(element(i)->FirstChildElement("inertial"));
  }
  for (const size_t i : held) {
    if (split.held_share == 1) break;
    SetInertial(
        InertialParameters::FromVector(
            split.held_share * tree.links[group.links[i]].inertial.ToVector()),
        element(i));
  }
  const std::string loss = SplitLoss(
      tree, group,
      InertialParameters::FromVector(total.ToVector() - of_held.ToVector()),
      split, held);
  if (!loss.empty() && losses != nullptr) losses->push_back(loss);
}

int FindJoint(const std::string& path, const RobotTree& tree,
              const Link& link) {
  for (size_t j = 0; j < tree.joints.size(); ++j) {
    const TreeJoint& joint = tree.joints[j];
    if (joint.joint.name == link.joint.name && !joint.is_fixed &&
        tree.links[joint.child].name == link.name) {
      return static_cast<int>(j);
    }
  }
  throw InputError(path, "", link.name,
                   "expected a link of the robot, moved by its joint " +
                       Quoted(link.joint.name));
}

// Sets the origin of joint `j` so that its frame has the pose X_HJ in `head`,
// which fixed joints connect to its parent.
void SetJointOrigin(const std::string& path, int head, int j,
                    const Isometry3d& X_HJ, RobotTree* tree, XMLElement* root) {
  TreeJoint& joint = tree->joints[j];
  const RigidGroup group = FindGroup(*tree, head);
  if (std::count(group.links.begin(), group.links.end(), joint.parent) == 0) {
    throw InputError(
        path, "", tree->links[head].name,
        "expected the link that carries joint " + Quoted(joint.joint.name));
  }
  joint.X_PJ = PoseInGroup(group, joint.parent).inverse() * X_HJ;
  SetOrigin(joint.X_PJ, Find(root, "joint", joint.joint.name));
}

int FindBase(const std::string& path, const RobotTree& tree,
             const std::string& base, int first_joint) {
  int link = tree.joints[first_joint].parent;
  if (base.empty()) {
    while (tree.links[link].parent_joint >= 0) {
      link = tree.joints[tree.links[link].parent_joint].parent;
    }
    return link;
  }
  const std::optional<int> found = tree.FindLink(base);
  if (!found) {
    throw InputError(path, "", base, "expected a link of the URDF file");
  }
  return *found;
}

void SetGeometry(const std::string& path, const Robot& robot,
                 const std::vector<int>& joints, const std::string& base,
                 RobotTree* tree, XMLElement* root) {
  const int root_link = FindBase(path, *tree, base, joints.front());
  for (size_t i = 0; i < joints.size(); ++i) {
    const Link& link = robot.links[i];
    const int parent = robot.parent(static_cast<int>(i));
    const int head =
        parent < 0 ? root_link : tree->joints[joints[parent]].child;
    SetJointOrigin(path, head, joints[i], link.X_PF * link.X_ML, tree, root);
  }
  const std::optional<int> tool = tree->FindLink(robot.tool_name);
  if (!tool) return;
  SetJointOrigin(path, tree->joints[joints.back()].child,
                 tree->links[*tool].parent_joint, robot.X_LT, tree, root);
}

}  // namespace

std::string UpdateUrdf(const Document& file, const Robot& robot, bool geometry,
                       const std::string& base,
                       std::vector<std::string>* losses) {
  const std::string& path = file.name();
  RobotTree tree = ReadUrdfTree(file);
  std::vector<int> joints;
  for (const Link& link : robot.links) {
    joints.push_back(FindJoint(path, tree, link));
  }
  if (!robot.held.empty()) {
    ChosenJoints chosen;
    chosen.base = FindBase(path, tree, base, joints.front());
    chosen.joints = joints;
    HoldOtherJoints(path, chosen, robot.held, &tree);
  }
  XMLDocument document;
  document.Parse(file.Text(32L << 20).c_str());
  XMLElement* root = document.FirstChildElement("robot");
  if (root == nullptr) {
    throw InputError(path, "", "", "expected the robot's URDF file");
  }
  if (geometry && !joints.empty()) {
    SetGeometry(path, robot, joints, base, &tree, root);
  }
  for (size_t i = 0; i < joints.size(); ++i) {
    const Link& link = robot.links[i];
    if (link.inertial.mass > 0) {
      DistributeInertia(link.inertial, tree, tree.joints[joints[i]].child, root,
                        losses);
    }
    SetDynamics(link.joint, Find(root, "joint", link.joint.name));
  }
  return XmlText(document);
}

}  // namespace armcal

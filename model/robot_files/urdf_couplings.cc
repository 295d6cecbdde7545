#include "model/robot_files/urdf_couplings.h"

#include <algorithm>
#include <string>
#include <vector>

#include "model/text/input_text.h"

namespace armcal {
namespace {

std::string Place(const XmlElement& element) {
  return "line " + std::to_string(element.line()) + ", <" + element.tag() +
         ">" + (element.Has("name") ? " " + Quoted(element.Text("name")) : "");
}

int FindJoint(const RobotTree& tree, const std::string& name) {
  for (size_t j = 0; j < tree.joints.size(); ++j) {
    if (tree.joints[j].joint.name == name) return static_cast<int>(j);
  }
  return -1;
}

// Whether a joint moves a link with mass, itself or by joints further out.
bool MovesMass(const RobotTree& tree, int joint) {
  std::vector<int> open = {tree.joints[joint].child};
  while (!open.empty()) {
    const TreeLink& link = tree.links[open.back()];
    open.pop_back();
    if (link.has_inertial || link.error) return true;
    for (const int j : link.child_joints) open.push_back(tree.joints[j].child);
  }
  return false;
}

// A joint that follows another adds its links' inertia to the other's torque;
// one that moves no mass, as of a cover, does not.
void AddMimic(const XmlElement& element, int follower, RobotTree* tree) {
  const std::optional<XmlElement> mimic = element.Child("mimic");
  if (!mimic || !tree->joints[follower].is_supported) return;
  TreeCoupling coupling{"line " + std::to_string(element.line()) +
                            ", <mimic> of joint " +
                            Quoted(tree->joints[follower].joint.name),
                        {follower}};
  const int leader =
      mimic->Has("joint") ? FindJoint(*tree, mimic->Text("joint")) : -1;
  if (leader >= 0 && MovesMass(*tree, follower)) {
    coupling.joints.push_back(leader);
  }
  if (leader >= 0) {
    const auto number = [&mimic](const char* name, double without) {
      return ParseNumber(mimic->Has(name) ? mimic->Text(name) : "")
          .value_or(without);
    };
    tree->joints[follower].mimic = {leader, number("multiplier", 1),
                                    number("offset", 0)};
  }
  tree->couplings.push_back(std::move(coupling));
}

int RequireLink(const XmlElement& element, const std::string& name,
                const LinkIndex& links, const RobotTree& tree) {
  const auto found = links.find(name);
  if (found != links.end()) return found->second;
  element.Refuse("", name,
                 "expected one of the links " + LinkNames(tree.links));
}

void AddLoop(const XmlElement& element, int link, int other, RobotTree* tree) {
  tree->couplings.push_back({Place(element) + ", which closes a loop from " +
                                 Quoted(tree->links[link].name) + " to " +
                                 Quoted(tree->links[other].name),
                             tree->JointsBetween(link, other)});
}

// <link1 link="..."/> and <link2 link="..."/>.
void AddLoopJoint(const XmlElement& element, const LinkIndex& links,
                  RobotTree* tree) {
  int ends[2];
  for (int i = 0; i < 2; ++i) {
    const XmlElement end = element.RequiredChild(i == 0 ? "link1" : "link2");
    ends[i] = RequireLink(end, end.Name("link"), links, *tree);
  }
  AddLoop(element, ends[0], ends[1], tree);
}

// <parent>...</parent> and <child>...</child>, as in SDF; "world" is the root.
void AddGazeboJoint(const XmlElement& element, const LinkIndex& links,
                    RobotTree* tree) {
  int ends[2];
  for (int i = 0; i < 2; ++i) {
    const XmlElement end = element.RequiredChild(i == 0 ? "parent" : "child");
    const std::string name = end.Content();
    ends[i] = name == "world" && links.count(name) == 0
                  ? tree->roots.front()
                  : RequireLink(end, name, links, *tree);
  }
  AddLoop(element, ends[0], ends[1], tree);
}

}  // namespace

void ReadUrdfCouplings(const XmlElement& root, const LinkIndex& links,
                       RobotTree* tree) {
  const std::vector<XmlElement> joints = root.Children("joint");
  for (size_t j = 0; j < joints.size(); ++j) {
    AddMimic(joints[j], static_cast<int>(j), tree);
  }
  for (const char* tag : {"loop_joint", "drake:loop_joint"}) {
    for (const XmlElement& element : root.Children(tag)) {
      AddLoopJoint(element, links, tree);
    }
  }
  for (const XmlElement& gazebo : root.Children("gazebo")) {
    for (const XmlElement& element : gazebo.Children("joint")) {
      AddGazeboJoint(element, links, tree);
    }
  }
}

}  // namespace armcal

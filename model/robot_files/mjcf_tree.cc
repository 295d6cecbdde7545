#include "model/robot_files/mjcf_tree.h"

#include <algorithm>
#include <array>
#include <set>
#include <string_view>
#include <utility>

#include "model/robot_files/mjcf_actuators.h"
#include "model/robot_files/mjcf_defaults.h"
#include "model/robot_files/mjcf_inertial.h"
#include "model/robot_files/mjcf_joint.h"
#include "model/robot_files/mjcf_pose.h"
#include "model/robot_files/mjcf_settings.h"
#include "model/text/input_text.h"
#include "model/text/xml_element.h"

namespace armcal {
namespace {

using Eigen::Isometry3d;

// What a body may hold.
constexpr std::array<std::string_view, 12> kInBodies = {
    "body",   "inertial", "joint", "freejoint", "geom", "site",
    "camera", "light",    "user",  "plugin",    "skin", "text"};

void RefuseIncludes(const XmlElement& element) {
  for (const XmlElement& child : element.Children(nullptr)) {
    if (child.tag() == "include") {
      child.Refuse("file", child.Has("file") ? child.Text("file") : "",
                   "expected a file without <include>, as armcal opens no "
                   "other; MuJoCo's compile saves a model as one");
    }
    RefuseIncludes(child);
  }
}

void AddNames(const XmlElement& element, std::set<std::string>* names) {
  if (element.Has("name")) names->insert(element.Text("name"));
  for (const XmlElement& child : element.Children(nullptr)) {
    AddNames(child, names);
  }
}

class MjcfTreeReader {
 public:
  explicit MjcfTreeReader(const XmlElement& root)
      : defaults_(root), settings_(ReadMjcfSettings(root)) {
    AddNames(root, &given_);
  }

  RobotTree Read(const XmlElement& root);

 private:
  void ReadBodies(const XmlElement& parent, int parent_link,
                  const std::string& childclass);
  void ReadBody(XmlElement body, int parent, const std::string& around);
  int AddLink(TreeLink link, const XmlElement& element);
  void AddJoint(TreeJoint joint, int parent, int child);
  int AddMovedLinks(const XmlElement& body, const std::string& childclass,
                    TreeLink link, int parent, const Isometry3d& X_PB);
  // The element's name, or one such as "body3" that is nobody's.
  std::string NameOr(const XmlElement& element, const std::string& kind,
                     const LinkIndex& used) const;
  std::string JointName(const XmlElement& element);

  MjcfDefaults defaults_;
  MjcfSettings settings_;
  RobotTree tree_;
  std::set<std::string> given_;  // all names in the file
  LinkIndex links_, joint_lines_;
};

std::string MjcfTreeReader::NameOr(const XmlElement& element,
                                   const std::string& kind,
                                   const LinkIndex& used) const {
  if (element.Has("name")) return element.Name("name");
  std::string name = kind + std::to_string(used.size());
  while (used.count(name) > 0 || given_.count(name) > 0) name += "_";
  return name;
}

std::string MjcfTreeReader::JointName(const XmlElement& element) {
  const std::string name =
      NameOr(element, "joint", joint_lines_);  // from joint0, as MuJoCo counts
  const auto [at, is_new] = joint_lines_.emplace(name, element.line());
  if (!is_new) element.RefuseUsedName(name, at->second);
  return name;
}

int MjcfTreeReader::AddLink(TreeLink link, const XmlElement& element) {
  const int number = static_cast<int>(tree_.links.size());
  const auto [at, is_new] = links_.emplace(link.name, number);
  if (!is_new) element.RefuseUsedName(link.name, tree_.links[at->second].line);
  tree_.links.push_back(std::move(link));
  return number;
}

void MjcfTreeReader::AddJoint(TreeJoint joint, int parent, int child) {
  const int number = static_cast<int>(tree_.joints.size());
  joint.parent = parent;
  joint.child = child;
  tree_.links[parent].child_joints.push_back(number);
  tree_.links[child].parent_joint = number;
  tree_.joints.push_back(std::move(joint));
}

// A joint moves what the one before it has moved.
int MjcfTreeReader::AddMovedLinks(const XmlElement& body,
                                  const std::string& childclass, TreeLink link,
                                  int parent, const Isometry3d& X_PB) {
  std::vector<XmlElement> elements = body.Children("joint");
  for (const XmlElement& free : body.Children("freejoint")) {
    elements.push_back(free);
  }
  Isometry3d X = X_PB;
  for (size_t i = 0; i < elements.size(); ++i) {
    XmlElement element = elements[i];
    const std::string name = JointName(element);
    element.SetOwner("joint " + Quoted(name));
    TreeJoint joint =
        ReadMjcfJoint(defaults_.Of(element, childclass), X, name, settings_);
    TreeLink moved;
    moved.name = link.name + "_" + name;
    moved.line = element.line();
    if (i + 1 == elements.size()) std::swap(moved, link);
    const int child = AddLink(std::move(moved), body);
    AddJoint(std::move(joint), parent, child);
    parent = child;
    X.setIdentity();
  }
  if (!elements.empty()) return parent;
  TreeJoint fixed;
  fixed.type = "fixed";
  fixed.is_fixed = true;
  fixed.line = body.line();
  fixed.joint.name = link.name;
  fixed.X_PJ = X_PB;
  const int child = AddLink(std::move(link), body);
  AddJoint(std::move(fixed), parent, child);
  return child;
}

void MjcfTreeReader::ReadBody(XmlElement body, int parent,
                              const std::string& around) {
  TreeLink link;
  link.name = NameOr(body, "body", links_);
  link.line = body.line();
  body.SetOwner("body " + Quoted(link.name));
  const std::string childclass = defaults_.ChildClass(body, around);
  const Isometry3d X_PB = ReadMjcfPose(MjcfElement({body}), settings_);
  ReadMjcfInertial(body, childclass, defaults_, settings_, &link);
  if (MjcfElement({body}).NumberOr("gravcomp", "", 0) != 0) {
    link.notes.push_back("the gravcomp of body " + Quoted(link.name) +
                         " is not used: torques hold its weight");
  }
  const int moved =
      AddMovedLinks(body, childclass, std::move(link), parent, X_PB);
  ReadBodies(body, moved, childclass);
}

void MjcfTreeReader::ReadBodies(const XmlElement& parent, int parent_link,
                                const std::string& childclass) {
  for (const XmlElement& child : parent.Children(nullptr)) {
    if (child.tag() == "body") {
      ReadBody(child, parent_link, childclass);
    } else if (std::count(kInBodies.begin(), kInBodies.end(), child.tag()) ==
               0) {
      child.Refuse("", child.tag(),
                   "expected a body, inertial, joint, geom, site, camera or "
                   "light; what MuJoCo makes bodies from, its compile turns "
                   "into them");
    }
  }
}

RobotTree MjcfTreeReader::Read(const XmlElement& root) {
  tree_.name = root.Has("model") ? root.Name("model") : "robot";
  tree_.joint_types = "a hinge or slide joint, or none,";
  tree_.gravity = settings_.gravity;
  tree_.notes = settings_.notes;
  TreeLink world;
  world.name = "world";
  world.line = root.line();
  AddLink(std::move(world), root);
  tree_.roots = {0};
  for (const XmlElement& worldbody : root.Children("worldbody")) {
    ReadBodies(worldbody, 0, defaults_.ChildClass(worldbody, ""));
  }
  ReadMjcfActuators(root, defaults_, settings_, &tree_);
  ReadMjcfConstraints(root, &tree_);
  return std::move(tree_);
}

}  // namespace

RobotTree ReadMjcfTree(const Document& document) {
  const XmlFile file(document);
  const XmlElement root = file.root();
  if (root.tag() != "mujoco") {
    root.Refuse("", root.tag(), "expected the root element <mujoco>");
  }
  RefuseIncludes(root);
  return MjcfTreeReader(root).Read(root);
}

}  // namespace armcal

#include "model/robot_files/mjcf/mjcf_tree.h"

#include <algorithm>
#include <array>
#include <memory>
#include <set>
#include <string_view>
#include <utility>

#include "model/robot_files/mjcf/mjcf_actuators.h"
#include "model/robot_files/mjcf/mjcf_couplings.h"
#include "model/robot_files/mjcf/mjcf_defaults.h"
#include "model/robot_files/mjcf/mjcf_gears.h"
#include "model/robot_files/mjcf/mjcf_includes.h"
#include "model/robot_files/mjcf/mjcf_inertial.h"
#include "model/robot_files/mjcf/mjcf_joint.h"
#include "model/robot_files/mjcf/mjcf_meshes.h"
#include "model/robot_files/mjcf/mjcf_parts.h"
#include "model/robot_files/mjcf/mjcf_pose.h"
#include "model/robot_files/mjcf/mjcf_settings.h"
#include "model/text/input_text.h"
#include "model/text/xml_element.h"

namespace armcal {
namespace {

using Eigen::Isometry3d;

// What a body may hold.
constexpr std::array<std::string_view, 12> kInBodies = {
    "body",   "inertial", "joint", "freejoint", "geom", "site",
    "camera", "light",    "user",  "plugin",    "skin", "text"};

void AddNames(const XmlElement& element, std::set<std::string>* names) {
  if (element.Has("name")) names->insert(element.Text("name"));
  for (const XmlElement& child : element.Children(nullptr)) {
    AddNames(child, names);
  }
}

// What MuJoCo makes of other elements, such as <composite> and <attach>, are
// bodies that armcal does not know.
InputError UnknownElement(const XmlElement& element) {
  try {
    element.Refuse(
        "", element.tag(),
        "expected a body, inertial, joint, geom, site, camera, light "
        "or frame; what MuJoCo makes bodies from, its compile turns "
        "into them");
  } catch (const InputError& error) {
    return error;
  }
}

class MjcfTreeReader {
 public:
  MjcfTreeReader(const XmlElement& root, const ModelFolder& folder,
                 std::vector<std::string> notes)
      : defaults_(root),
        settings_(ReadMjcfSettings(root)),
        gears_(root),
        meshes_(root, defaults_, folder) {
    AddNames(root, &given_);
    tree_.notes = std::move(notes);
  }

  RobotTree Read(const XmlElement& root);

 private:
  void ReadParts(const std::vector<MjcfPart>& parts, int link);
  void ReadBody(const MjcfPart& part, int parent);
  int AddLink(TreeLink link, const XmlElement& element);
  void AddJoint(TreeJoint joint, int parent, int child);
  int AddMovedLinks(const XmlElement& body, const std::vector<MjcfPart>& parts,
                    TreeLink link, int parent, const Isometry3d& X_PB);
  int AddFixedLink(const XmlElement& body, TreeLink link, int parent,
                   const Isometry3d& X_PB);
  void ScaleMasses();
  // The element's name, or one such as "body3" that is nobody's.
  std::string NameOr(const XmlElement& element, const std::string& kind,
                     const LinkIndex& used) const;
  std::string JointName(const XmlElement& element);

  MjcfDefaults defaults_;
  MjcfSettings settings_;
  MjcfGears gears_;
  MjcfMeshes meshes_;
  RobotTree tree_;
  std::set<std::string> given_;  // all names in the file
  LinkIndex links_, joint_lines_;
  MjcfNames names_;
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
  if (!joint.is_fixed) names_.joints.emplace(joint.joint.name, number);
  tree_.links[parent].child_joints.push_back(number);
  tree_.links[child].parent_joint = number;
  tree_.joints.push_back(std::move(joint));
}

int MjcfTreeReader::AddFixedLink(const XmlElement& body, TreeLink link,
                                 int parent, const Isometry3d& X_PB) {
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

// A joint moves what the one before it has moved.
int MjcfTreeReader::AddMovedLinks(const XmlElement& body,
                                  const std::vector<MjcfPart>& parts,
                                  TreeLink link, int parent,
                                  const Isometry3d& X_PB) {
  const auto [joints, gears] = gears_.Split(parts, defaults_, settings_);
  for (const MjcfPart* gear : gears) {
    link.notes.push_back("joint " + Quoted(JointName(gear->element)) +
                         ", by which link " + Quoted(link.name) +
                         " yields, is not used: armcal's joints are rigid");
  }
  Isometry3d X = X_PB;
  for (size_t i = 0; i < joints.size(); ++i) {
    XmlElement element = joints[i]->element;
    const std::string name = JointName(element);
    element.SetOwner("joint " + Quoted(name));
    TreeJoint joint =
        ReadMjcfJoint(defaults_.Of(element, joints[i]->childclass), X,
                      joints[i]->X_BF, name, settings_);
    TreeLink moved;
    moved.name = link.name + "_" + name;
    moved.line = element.line();
    moved.is_massless = i + 1 < joints.size();
    if (!moved.is_massless) std::swap(moved, link);
    const int child = AddLink(std::move(moved), body);
    AddJoint(std::move(joint), parent, child);
    parent = child;
    X.setIdentity();
  }
  return joints.empty() ? AddFixedLink(body, std::move(link), parent, X_PB)
                        : parent;
}

void MjcfTreeReader::ReadBody(const MjcfPart& part, int parent) {
  XmlElement body = part.element;
  TreeLink link;
  link.name = NameOr(body, "body", links_);
  link.line = body.line();
  body.SetOwner("body " + Quoted(link.name));
  const std::string childclass = defaults_.ChildClass(body, part.childclass);
  const std::vector<MjcfPart> parts =
      ReadMjcfParts(body, childclass, defaults_, settings_);
  try {
    ReadMjcfInertial(body, parts, defaults_, settings_, &meshes_, &link);
  } catch (const InputError& error) {
    link.error = error;
  }
  const MjcfElement given({body});
  if (given.NumberOr("gravcomp", "", 0) != 0) {
    link.notes.push_back("the gravcomp of body " + Quoted(link.name) +
                         " is not used: torques hold its weight");
  }
  const Isometry3d X_PB = part.X_BF * ReadMjcfPose(given, settings_);
  const std::string name = link.name;
  const int moved = AddMovedLinks(body, parts, std::move(link), parent, X_PB);
  names_.bodies.emplace(name, moved);
  if (given.Text("mocap") == "true") names_.mocap_links.insert(moved);
  ReadParts(parts, moved);
}

// What stands in a body that moves with `link`.
void MjcfTreeReader::ReadParts(const std::vector<MjcfPart>& parts, int link) {
  for (const MjcfPart& part : parts) {
    const std::string tag = part.element.tag();
    if (tag == "body") {
      ReadBody(part, link);
    } else if (tag == "site" || tag == "geom") {
      LinkIndex& index = tag == "site" ? names_.sites : names_.geoms;
      if (part.element.Has("name")) {
        index.emplace(part.element.Text("name"), link);
      }
    } else if (std::count(kInBodies.begin(), kInBodies.end(), tag) == 0) {
      if (!tree_.links[link].error) {
        tree_.links[link].error = UnknownElement(part.element);
      }
    }
  }
}

// All bodies by one factor, so that they weigh what the compiler is told.
void MjcfTreeReader::ScaleMasses() {
  if (settings_.totalmass <= 0) return;
  double sum = 0;
  for (const TreeLink& link : tree_.links) {
    if (link.error) throw InputError(*link.error);
    sum += link.inertial.mass;
  }
  if (sum <= 0) return;
  for (TreeLink& link : tree_.links) {
    link.inertial.mass *= settings_.totalmass / sum;
    link.inertial.first_moment *= settings_.totalmass / sum;
    link.inertial.inertia *= settings_.totalmass / sum;
  }
}

RobotTree MjcfTreeReader::Read(const XmlElement& root) {
  tree_.name = root.Has("model") ? root.Name("model") : "robot";
  tree_.joint_types = "a hinge or slide joint, or none,";
  tree_.gravity = settings_.gravity;
  tree_.notes.insert(tree_.notes.end(), settings_.notes.begin(),
                     settings_.notes.end());
  TreeLink world;
  world.name = "world";
  world.line = root.line();
  AddLink(std::move(world), root);
  names_.bodies.emplace("world", 0);
  tree_.roots = {0};
  for (const XmlElement& worldbody : root.Children("worldbody")) {
    ReadParts(ReadMjcfParts(worldbody, defaults_.ChildClass(worldbody, ""),
                            defaults_, settings_),
              0);
  }
  ScaleMasses();
  if (!meshes_.read().empty()) {
    tree_.notes.push_back(
        "read as well, for inertia that the file does not "
        "give: " +
        JoinNames(meshes_.read()));
  }
  // Tendons add to the friction of joints that pushing actuators take from.
  ReadMjcfCouplings(root, defaults_, names_, &tree_);
  ReadMjcfActuators(root, defaults_, settings_, &tree_);
  return std::move(tree_);
}

}  // namespace

RobotTree ReadMjcfTree(const Document& document, const std::string& folder) {
  const ModelFolder files(document, folder);
  std::vector<std::string> notes;
  const std::unique_ptr<XmlFile> file = ReadMjcfXml(document, files, &notes);
  const XmlElement root = file->root();
  if (root.tag() != "mujoco") {
    root.Refuse("", root.tag(), "expected the root element <mujoco>");
  }
  return MjcfTreeReader(root, files, std::move(notes)).Read(root);
}

}  // namespace armcal

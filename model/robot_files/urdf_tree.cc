#include "model/robot_files/urdf_tree.h"

#include <optional>
#include <unordered_map>
#include <utility>

#include "model/robot_files/urdf_couplings.h"
#include "model/robot_files/urdf_elements.h"
#include "model/text/input_error.h"
#include "model/text/input_text.h"
#include "model/text/xml_element.h"

namespace armcal {
namespace {

void ReadLinks(const XmlElement& root, RobotTree* tree, LinkIndex* index) {
  for (const XmlElement& element : root.Children("link")) {
    TreeLink link = ReadUrdfLink(element);
    const int number = static_cast<int>(tree->links.size());
    const auto [at, is_new] = index->emplace(link.name, number);
    if (!is_new) {
      element.RefuseUsedName(link.name, tree->links[at->second].line);
    }
    tree->links.push_back(std::move(link));
  }
}

void ReadJoints(const XmlElement& root, const LinkIndex& links,
                RobotTree* tree) {
  std::unordered_map<std::string, int> index;
  for (XmlElement element : root.Children("joint")) {
    TreeJoint joint = ReadUrdfJoint(element, tree->links, links);
    const int number = static_cast<int>(tree->joints.size());
    const auto [at, is_new] = index.emplace(joint.joint.name, number);
    if (!is_new) {
      element.RefuseUsedName(joint.joint.name, tree->joints[at->second].line);
    }
    TreeLink& child = tree->links[joint.child];
    if (child.parent_joint >= 0) {
      element.SetOwner("joint " + Quoted(joint.joint.name));
      const Joint& other = tree->joints[child.parent_joint].joint;
      element.RequiredChild("child").Refuse(
          "link", child.name,
          "expected a link with one parent: joint " + Quoted(other.name) +
              " has it as its child already");
    }
    child.parent_joint = number;
    tree->links[joint.parent].child_joints.push_back(number);
    tree->joints.push_back(std::move(joint));
  }
}

// As no link has two parents, what cannot be reached from a root is or hangs on
// a loop; walking up from there ends in it.
void RefuseLoops(const std::string& path, const RobotTree& tree) {
  std::vector<char> reached(tree.links.size(), 0);
  std::vector<int> open = tree.roots;
  while (!open.empty()) {
    const int link = open.back();
    open.pop_back();
    reached[link] = 1;
    for (const int j : tree.links[link].child_joints) {
      open.push_back(tree.joints[j].child);
    }
  }
  const auto parent = [&](int link) {
    return tree.joints[tree.links[link].parent_joint].parent;
  };
  for (size_t i = 0; i < tree.links.size(); ++i) {
    if (reached[i]) continue;
    int link = static_cast<int>(i);
    for (; !reached[link]; link = parent(link)) reached[link] = 1;
    std::vector<std::string> names = {tree.links[link].name};
    for (int k = parent(link); k != link; k = parent(k)) {
      names.insert(names.begin(), tree.links[k].name);
    }
    const TreeJoint& joint = tree.joints[tree.links[link].parent_joint];
    throw InputError(
        path,
        "line " + std::to_string(joint.line) + ", joint " +
            Quoted(joint.joint.name),
        "", "expected a tree: the links " + JoinNames(names) + " form a loop");
  }
}

}  // namespace

RobotTree ReadUrdfTree(const Document& document) {
  const XmlFile file(document);
  const XmlElement root = file.root();
  if (root.tag() != "robot") {
    root.Refuse("", root.tag(), "expected the root element <robot>");
  }
  RobotTree tree;
  tree.name = root.Has("name") ? root.Name("name") : "robot";
  LinkIndex index;
  ReadLinks(root, &tree, &index);
  if (tree.links.empty()) {
    root.Refuse("", "", "expected at least one <link>");
  }
  ReadJoints(root, index, &tree);
  for (size_t i = 0; i < tree.links.size(); ++i) {
    if (tree.links[i].parent_joint < 0) {
      tree.roots.push_back(static_cast<int>(i));
    }
  }
  RefuseLoops(document.name(), tree);
  ReadUrdfCouplings(root, index, &tree);
  return tree;
}

// Of what cannot be read the reader tells, if the robot has it.
std::vector<std::string> WideAngles(const Document& document) {
  constexpr double kWholeTurn = 6.295;  // rad, rounded to 6.28 or 6.29
  const XmlFile file(document);
  const XmlElement root = file.root();
  std::vector<std::string> wide;
  const auto look = [&](const std::string& what, const XmlElement& owner) {
    const std::optional<XmlElement> origin = owner.Child("origin");
    if (!origin || !origin->Has("rpy")) return;
    const Eigen::Vector3d rpy = origin->Vector("rpy", "rad");
    Eigen::Index axis = 0;
    if (!(rpy.cwiseAbs().maxCoeff(&axis) > kWholeTurn)) return;
    wide.push_back(what + " by " + NumberText(rpy[axis]) + " rad");
  };
  for (const char* tag : {"joint", "link"}) {
    for (const XmlElement& element : root.Children(tag)) {
      try {
        const std::string what = tag + (" " + element.Name("name"));
        look(what, element);
        if (const auto inertial = element.Child("inertial")) {
          look("the inertia of " + what, *inertial);
        }
      } catch (const InputError&) {
        continue;
      }
    }
  }
  return wide;
}

}  // namespace armcal

#include "model/robot_files/mjcf/mjcf_couplings.h"

#include <algorithm>
#include <set>
#include <vector>

#include "model/text/input_text.h"

namespace armcal {
namespace {

std::string NameOf(const std::string& section, const XmlElement& element) {
  return section + " <" + element.tag() + ">" +
         (element.Has("name") ? " " + Quoted(element.Text("name")) : "");
}

std::string Place(const std::string& section, const XmlElement& element) {
  return "line " + std::to_string(element.line()) + ", " +
         NameOf(section, element);
}

int Find(const XmlElement& element, const char* attribute,
         const LinkIndex& index, const char* kind) {
  const std::string name = element.Name(attribute);
  const auto found = index.find(name);
  if (found != index.end()) return found->second;
  element.Refuse(attribute, name,
                 std::string("expected a ") + kind + " of the file");
}

// Joints of one tendon, and what it does to them.
struct Tendon {
  XmlElement element;
  std::set<int> joints;
  std::string acts;  // "stiffness"; empty where it does nothing
};

class CouplingReader {
 public:
  CouplingReader(const XmlElement& root, const MjcfDefaults& defaults,
                 const MjcfNames& names, RobotTree* tree)
      : root_(root), defaults_(defaults), names_(names), tree_(tree) {}

  void Read() {
    for (const XmlElement& section : root_.Children("tendon")) {
      for (const XmlElement& element : section.Children(nullptr)) {
        ReadTendon(element);
      }
    }
    for (const XmlElement& section : root_.Children("equality")) {
      for (const XmlElement& element : section.Children(nullptr)) {
        ReadEquality(element);
      }
    }
    for (const XmlElement& section : root_.Children("actuator")) {
      for (const XmlElement& element : section.Children(nullptr)) {
        // One actuator drives all joints of the tendon at once.
        if (element.Has("tendon")) Act(element, "tendon", "actuator");
      }
    }
    for (const Tendon& tendon : tendons_) AddTendon(tendon);
  }

 private:
  void ReadTendon(const XmlElement& element);
  void ReadEquality(const XmlElement& element);
  void AddBetween(const XmlElement& element, int link, int other);
  void Act(const XmlElement& element, const char* attribute,
           const std::string& how);
  bool TakeForJoint(const Tendon& tendon);
  void AddTendon(const Tendon& tendon);
  std::set<int> JointsOf(const XmlElement& tendon) const;
  int LinkOf(const XmlElement& part) const;

  const XmlElement& root_;
  const MjcfDefaults& defaults_;
  const MjcfNames& names_;
  RobotTree* tree_;
  std::vector<Tendon> tendons_;
};

// The link that a part of a spatial tendon's path stands on; -1: none.
int CouplingReader::LinkOf(const XmlElement& part) const {
  if (part.tag() == "site") {
    return Find(part, "site", names_.sites, "site");
  }
  if (part.tag() != "geom" || names_.geoms.count(part.Text("geom")) == 0) {
    return -1;
  }
  return names_.geoms.at(part.Text("geom"));
}

// A spatial tendon pulls on the joints that move one point of its path relative
// to the next.
std::set<int> CouplingReader::JointsOf(const XmlElement& tendon) const {
  std::set<int> joints;
  int last = -1;
  for (const XmlElement& part : tendon.Children(nullptr)) {
    if (part.tag() == "joint") {
      joints.insert(Find(part, "joint", names_.joints, "joint"));
      continue;
    }
    const int link = LinkOf(part);
    if (link < 0) {
      // A pulley begins another branch.
      if (part.tag() == "pulley") last = -1;
      continue;
    }
    if (last >= 0) {
      const std::vector<int> between = tree_->JointsBetween(last, link);
      joints.insert(between.begin(), between.end());
    }
    last = link;
  }
  return joints;
}

void CouplingReader::ReadTendon(const XmlElement& element) {
  Tendon tendon{element, JointsOf(element), ""};
  const MjcfElement given = defaults_.OfTendon(element);
  for (const char* attribute :
       {"frictionloss", "stiffness", "damping", "armature"}) {
    const std::string text = given.Text(attribute);
    for (const auto& word : SplitWords(text)) {
      if (ParseNumber(word).value_or(1) != 0) tendon.acts = attribute;
    }
  }
  tendons_.push_back(std::move(tendon));
}

void CouplingReader::Act(const XmlElement& element, const char* attribute,
                         const std::string& how) {
  const std::string name = element.Name(attribute);
  for (Tendon& tendon : tendons_) {
    if (!tendon.element.Has("name") || tendon.element.Text("name") != name) {
      continue;
    }
    // One joint's torque stays its own.
    if (how == "actuator" && tendon.joints.size() < 2) return;
    tendon.acts = how;
    return;
  }
  element.Refuse(attribute, name, "expected a tendon of the file");
}

// Of a tendon on a single joint friction is the joint's, and its spring is
// dropped as one of the joint is; others are couplings.
bool CouplingReader::TakeForJoint(const Tendon& tendon) {
  const XmlElement& element = tendon.element;
  const auto parts = element.Children("joint");
  if (element.tag() != "fixed" || parts.size() != 1 ||
      tendon.joints.size() != 1) {
    return false;
  }
  TreeJoint& on = tree_->joints[*tendon.joints.begin()];
  if (tendon.acts == "stiffness") {
    on.notes.push_back("the spring of " + NameOf("tendon", element) +
                       " is not used: armcal's joints have none");
    return true;
  }
  if (tendon.acts != "frictionloss") return false;
  const double coefficient = parts.front().Number("coef", "");
  on.joint.coulomb +=
      std::abs(coefficient) * defaults_.OfTendon(element).NonNegativeOr0(
                                  "frictionloss", EffortUnit(on.joint.type));
  return true;
}

void CouplingReader::AddTendon(const Tendon& tendon) {
  if (TakeForJoint(tendon)) return;
  if (tendon.acts.empty()) {
    tree_->notes.push_back("not used: " + NameOf("tendon", tendon.element) +
                           ", which has no stiffness, damping, friction "
                           "or actuator");
    return;
  }
  tree_->couplings.push_back(
      {Place("tendon", tendon.element) + " with its " + tendon.acts,
       {tendon.joints.begin(), tendon.joints.end()}});
}

// What connects two bodies closes a loop over the joints between them.
void CouplingReader::AddBetween(const XmlElement& element, int link,
                                int other) {
  if (names_.mocap_links.count(link) + names_.mocap_links.count(other) > 0) {
    tree_->notes.push_back(
        "not used, as it holds a body that only a "
        "simulation moves (mocap): " +
        NameOf("equality", element));
    return;
  }
  tree_->couplings.push_back(
      {Place("equality", element) + ", which closes a loop",
       tree_->JointsBetween(link, other)});
}

void CouplingReader::ReadEquality(const XmlElement& element) {
  const MjcfElement given = defaults_.OfEquality(element);
  if (given.Text("active") == "false") return;
  const std::string& tag = element.tag();
  if (tag == "connect" || tag == "weld") {
    if (element.Has("site1")) {
      AddBetween(element, Find(element, "site1", names_.sites, "site"),
                 Find(element, "site2", names_.sites, "site"));
    } else {
      AddBetween(element, Find(element, "body1", names_.bodies, "body"),
                 element.Has("body2")
                     ? Find(element, "body2", names_.bodies, "body")
                     : tree_->roots.front());
    }
  } else if (tag == "joint") {
    std::vector<int> joints;
    for (const char* attribute : {"joint1", "joint2"}) {
      if (!element.Has(attribute) && joints.size() == 1) continue;
      joints.push_back(Find(element, attribute, names_.joints, "joint"));
    }
    tree_->couplings.push_back({Place("equality", element), joints});
  } else if (tag == "tendon") {
    for (const char* attribute : {"tendon1", "tendon2"}) {
      if (element.Has(attribute)) Act(element, attribute, "equality");
    }
  } else {
    tree_->notes.push_back("not used: " + NameOf("equality", element));
  }
}

}  // namespace

void ReadMjcfCouplings(const XmlElement& root, const MjcfDefaults& defaults,
                       const MjcfNames& names, RobotTree* tree) {
  CouplingReader(root, defaults, names, tree).Read();
}

}  // namespace armcal

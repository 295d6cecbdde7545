#include "model/urdf_writer.h"

#include <tinyxml2.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>

#include "model/input_error.h"
#include "model/input_text.h"
#include "model/urdf_chain.h"
#include "model/urdf_tree.h"

namespace armcal {
namespace {

using Eigen::Isometry3d;
using Eigen::Matrix3d;
using Eigen::Vector3d;
using tinyxml2::XMLDocument;
using tinyxml2::XMLElement;

constexpr double kTurn = 6.28318530717958648;  // rad, or m

// Ten digits, which is more than any calibration knows; no "-0".
std::string Digits(double x) {
  char text[40];
  std::snprintf(text, sizeof(text), "%.10g", x == 0 ? 0.0 : x);
  return text;
}

std::string Digits(const Vector3d& v) {
  return Digits(v.x()) + " " + Digits(v.y()) + " " + Digits(v.z());
}

// Fixed-axis roll, pitch, yaw: R = Rz(yaw) Ry(pitch) Rx(roll).
Vector3d RollPitchYaw(const Matrix3d& R) {
  return {std::atan2(R(2, 1), R(2, 2)),
          std::atan2(-R(2, 0), std::hypot(R(2, 1), R(2, 2))),
          std::atan2(R(1, 0), R(0, 0))};
}

// The child called `name`, added at the end if there is none.
XMLElement* Child(XMLElement* parent, const char* name) {
  XMLElement* child = parent->FirstChildElement(name);
  if (child != nullptr) return child;
  return parent->InsertNewChildElement(name);
}

void SetOrigin(const Isometry3d& X, XMLElement* element) {
  XMLElement* origin = Child(element, "origin");
  origin->SetAttribute("xyz", Digits(Vector3d(X.translation())).c_str());
  origin->SetAttribute("rpy", Digits(RollPitchYaw(X.linear())).c_str());
}

void SetInertial(const InertialParameters& V, XMLElement* link) {
  const Vector3d com = V.first_moment / V.mass;
  const Matrix3d I =
      V.inertia - V.mass * (com.squaredNorm() * Matrix3d::Identity() -
                            com * com.transpose());
  XMLElement* inertial = Child(link, "inertial");
  Isometry3d X = Isometry3d::Identity();
  X.translation() = com;
  SetOrigin(X, inertial);
  Child(inertial, "mass")->SetAttribute("value", Digits(V.mass).c_str());
  XMLElement* inertia = Child(inertial, "inertia");
  const struct {
    const char* name;
    double value;
  } entries[] = {{"ixx", I(0, 0)}, {"ixy", I(0, 1)}, {"ixz", I(0, 2)},
                 {"iyy", I(1, 1)}, {"iyz", I(1, 2)}, {"izz", I(2, 2)}};
  for (const auto& e : entries) {
    inertia->SetAttribute(e.name, Digits(e.value).c_str());
  }
}

void SetDynamics(const Joint& joint, XMLElement* element) {
  XMLElement* dynamics = Child(element, "dynamics");
  dynamics->SetAttribute("damping", Digits(joint.viscous).c_str());
  dynamics->SetAttribute("friction", Digits(joint.coulomb).c_str());
}

// URDF wants limits of a revolute or prismatic joint; where the robot has none
// they are wide.
void SetLimits(const Joint& joint, XMLElement* element) {
  const auto or_wide = [](double x, double wide) {
    return Digits(std::isfinite(x) ? x : wide);
  };
  XMLElement* limit = Child(element, "limit");
  if (joint.type != JointType::kContinuous) {
    limit->SetAttribute("lower", or_wide(joint.lower, -kTurn).c_str());
    limit->SetAttribute("upper", or_wide(joint.upper, kTurn).c_str());
  }
  limit->SetAttribute("effort", or_wide(joint.effort, 1e6).c_str());
  limit->SetAttribute("velocity", or_wide(joint.velocity, 1e3).c_str());
}

XMLElement* AddJoint(const char* name, const char* type, const char* parent,
                     const char* child, const Isometry3d& origin,
                     XMLElement* robot) {
  XMLElement* joint = robot->InsertNewChildElement("joint");
  joint->SetAttribute("name", name);
  joint->SetAttribute("type", type);
  Child(joint, "parent")->SetAttribute("link", parent);
  Child(joint, "child")->SetAttribute("link", child);
  SetOrigin(origin, joint);
  return joint;
}

std::string Print(const XMLDocument& document) {
  tinyxml2::XMLPrinter printer;
  document.Print(&printer);
  return printer.CStr();
}

XMLElement* Find(XMLElement* root, const char* tag, const std::string& name) {
  for (XMLElement* e = root->FirstChildElement(tag); e != nullptr;
       e = e->NextSiblingElement(tag)) {
    const char* found = e->Attribute("name");
    if (found != nullptr && name == found) return e;
  }
  return nullptr;
}

// The link gets what the links that are fixed to it do not have already.
void DistributeInertia(const InertialParameters& total, const UrdfTree& tree,
                       int head, XMLElement* root) {
  const RigidGroup group = FindGroup(tree, head);
  XMLElement* link = Find(root, "link", tree.links[head].name);
  Vector10d rest = total.ToVector();
  for (size_t i = 1; i < group.links.size(); ++i) {
    const InertialParameters& fixed = tree.links[group.links[i]].inertial;
    rest -= fixed.ReexpressIn(group.X_HLs[i]).ToVector();
  }
  const InertialParameters remaining = InertialParameters::FromVector(rest);
  if (WhyUnphysical(remaining).empty()) {
    SetInertial(remaining, link);
    return;
  }
  for (size_t i = 1; i < group.links.size(); ++i) {
    XMLElement* fixed = Find(root, "link", tree.links[group.links[i]].name);
    XMLElement* inertial = fixed->FirstChildElement("inertial");
    if (inertial != nullptr) fixed->DeleteChild(inertial);
  }
  SetInertial(total, link);
}

int FindJoint(const std::string& path, const UrdfTree& tree, const Link& link) {
  for (size_t j = 0; j < tree.joints.size(); ++j) {
    const UrdfJoint& joint = tree.joints[j];
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
                    const Isometry3d& X_HJ, UrdfTree* tree, XMLElement* root) {
  UrdfJoint& joint = tree->joints[j];
  const RigidGroup group = FindGroup(*tree, head);
  if (std::count(group.links.begin(), group.links.end(), joint.parent) == 0) {
    throw InputError(
        path, "", tree->links[head].name,
        "expected the link that carries joint " + Quoted(joint.joint.name));
  }
  joint.X_PJ = PoseInGroup(group, joint.parent).inverse() * X_HJ;
  SetOrigin(joint.X_PJ, Find(root, "joint", joint.joint.name));
}

int FindBase(const std::string& path, const UrdfTree& tree,
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
                 UrdfTree* tree, XMLElement* root) {
  int head = FindBase(path, *tree, base, joints.front());
  for (size_t i = 0; i < joints.size(); ++i) {
    const Link& link = robot.links[i];
    SetJointOrigin(path, head, joints[i], link.X_PF * link.X_ML, tree, root);
    head = tree->joints[joints[i]].child;
  }
  const std::optional<int> tool = tree->FindLink(robot.tool_name);
  if (!tool) return;
  SetJointOrigin(path, head, tree->links[*tool].parent_joint, robot.X_LT, tree,
                 root);
}

// A name like `wish` that no link or joint of the robot has.
std::string NewName(const Robot& robot, const std::string& wish) {
  const auto is_taken = [&](const std::string& name) {
    if (name == robot.tool_name) return true;
    for (const Link& link : robot.links) {
      if (link.name == name || link.joint.name == name) return true;
    }
    return false;
  };
  std::string name = wish;
  while (is_taken(name)) name += "_";
  return name;
}

// The frame of a link whose joint turns about its own origin: URDF's. Standard
// DH links turn about the axis before them: their frame M stands in for L.
Isometry3d UrdfFrame(const Link& link) {
  const bool on_axis = link.X_ML.translation().norm() < 1e-12;
  return on_axis ? link.X_ML : Isometry3d::Identity();  // X_MU
}

}  // namespace

std::string MakeUrdf(const Robot& robot) {
  XMLDocument document;
  document.InsertEndChild(document.NewDeclaration());
  XMLElement* root = document.NewElement("robot");
  root->SetAttribute("name", robot.name.c_str());
  document.InsertEndChild(root);
  std::string parent = NewName(robot, "base_link");
  root->InsertNewChildElement("link")->SetAttribute("name", parent.c_str());
  Isometry3d X_UL = Isometry3d::Identity();  // of the parent
  for (const Link& link : robot.links) {
    const Isometry3d X_MU = UrdfFrame(link);
    XMLElement* element = root->InsertNewChildElement("link");
    element->SetAttribute("name", link.name.c_str());
    if (link.inertial.mass > 0) {
      SetInertial(link.inertial.ReexpressIn(X_MU.inverse() * link.X_ML),
                  element);
    }
    XMLElement* joint = AddJoint(
        link.joint.name.c_str(), JointTypeName(link.joint.type), parent.c_str(),
        link.name.c_str(), X_UL * link.X_PF * X_MU, root);
    const Vector3d axis = X_MU.linear().transpose() * Vector3d::UnitZ();
    Child(joint, "axis")->SetAttribute("xyz", Digits(axis).c_str());
    SetLimits(link.joint, joint);
    SetDynamics(link.joint, joint);
    parent = link.name;
    X_UL = X_MU.inverse() * link.X_ML;
  }
  if (!robot.tool_name.empty()) {
    root->InsertNewChildElement("link")->SetAttribute("name",
                                                      robot.tool_name.c_str());
    AddJoint(NewName(robot, robot.tool_name + "_joint").c_str(), "fixed",
             parent.c_str(), robot.tool_name.c_str(), X_UL * robot.X_LT, root);
  }
  return Print(document);
}

std::string UpdateUrdf(const std::string& path, const Robot& robot,
                       bool geometry, const std::string& base) {
  UrdfTree tree = ReadUrdfTree(path);
  std::vector<int> joints;
  for (const Link& link : robot.links) {
    joints.push_back(FindJoint(path, tree, link));
  }
  XMLDocument document;
  document.Parse(ReadTextFile(path, 32L << 20).c_str());
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
      DistributeInertia(link.inertial, tree, tree.joints[joints[i]].child,
                        root);
    }
    SetDynamics(link.joint, Find(root, "joint", link.joint.name));
  }
  return Print(document);
}

std::vector<std::string> UrdfLosses(const Robot& robot) {
  std::vector<std::string> losses;
  for (const Link& link : robot.links) {
    const Joint& joint = link.joint;
    if (joint.armature != 0) {
      losses.push_back("URDF has no field for the armature of " + joint.name +
                       ", " + NumberText(joint.armature));
    }
    if (joint.offset != 0) {
      losses.push_back("URDF has no field for the constant torque of " +
                       joint.name + ", " + NumberText(joint.offset));
    }
  }
  const Vector3d& g = robot.gravity;
  if ((g - Vector3d(0, 0, -g.norm())).norm() > 1e-9) {
    losses.push_back("URDF has no field for gravity, which here is " +
                     Digits(g) + " m/s^2, not along -z");
  }
  return losses;
}

}  // namespace armcal

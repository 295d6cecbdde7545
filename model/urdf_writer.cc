#include "model/urdf_writer.h"

#include <glog/logging.h>
#include <tinyxml2.h>

#include <cmath>
#include <cstdio>

#include "model/input_error.h"
#include "model/input_text.h"

namespace armcal {
namespace {

using Eigen::Isometry3d;
using Eigen::Matrix3d;
using Eigen::Vector3d;
using tinyxml2::XMLDocument;
using tinyxml2::XMLElement;

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

void SetLimits(const Joint& joint, XMLElement* element) {
  XMLElement* limit = Child(element, "limit");
  if (joint.type != JointType::kContinuous) {
    limit->SetAttribute(
        "lower", Digits(std::max(joint.lower, -2 * 3.14159265358979)).c_str());
    limit->SetAttribute(
        "upper", Digits(std::min(joint.upper, 2 * 3.14159265358979)).c_str());
  }
  limit->SetAttribute("effort", Digits(std::min(joint.effort, 1e6)).c_str());
  limit->SetAttribute("velocity",
                      Digits(std::min(joint.velocity, 1e3)).c_str());
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

Vector3d ReadVector(const XMLElement* element, const char* name) {
  Vector3d v = Vector3d::Zero();
  const char* text = element == nullptr ? nullptr : element->Attribute(name);
  if (text != nullptr) std::sscanf(text, "%lf %lf %lf", &v[0], &v[1], &v[2]);
  return v;
}

Isometry3d ReadOrigin(const XMLElement* parent) {
  const XMLElement* origin = parent->FirstChildElement("origin");
  const Vector3d rpy = ReadVector(origin, "rpy");
  Isometry3d X = Isometry3d::Identity();
  X.translation() = ReadVector(origin, "xyz");
  X.linear() = RotationFromRpy(rpy);
  return X;
}

InertialParameters ReadInertial(const XMLElement* inertial) {
  const auto number = [](const XMLElement* e, const char* name) {
    return e == nullptr ? 0 : e->DoubleAttribute(name);
  };
  const XMLElement* i = inertial->FirstChildElement("inertia");
  Matrix3d I;
  I << number(i, "ixx"), number(i, "ixy"), number(i, "ixz"), number(i, "ixy"),
      number(i, "iyy"), number(i, "iyz"), number(i, "ixz"), number(i, "iyz"),
      number(i, "izz");
  return InertialParameters::FromCenterOfMass(
             number(inertial->FirstChildElement("mass"), "value"),
             Vector3d::Zero(), I)
      .ReexpressIn(ReadOrigin(inertial));
}

// A link fixed to a moved one, with its pose in it. The file was read before,
// so that it is known to be a tree of sound numbers.
struct FixedLink {
  XMLElement* element;
  Isometry3d X_LC;
};

void CollectFixed(XMLElement* root, const std::string& link,
                  const Isometry3d& X, std::vector<FixedLink>* found) {
  for (XMLElement* joint = root->FirstChildElement("joint"); joint != nullptr;
       joint = joint->NextSiblingElement("joint")) {
    const char* type = joint->Attribute("type");
    const XMLElement* parent = joint->FirstChildElement("parent");
    const XMLElement* child = joint->FirstChildElement("child");
    if (type == nullptr || std::string(type) != "fixed" || parent == nullptr ||
        child == nullptr || link != parent->Attribute("link")) {
      continue;
    }
    const Isometry3d X_LC = X * ReadOrigin(joint);
    XMLElement* element = Find(root, "link", child->Attribute("link"));
    if (element == nullptr) continue;
    found->push_back({element, X_LC});
    CollectFixed(root, child->Attribute("link"), X_LC, found);
  }
}

// The link gets what its fixed links do not have already.
void DistributeInertia(const InertialParameters& total, XMLElement* root,
                       XMLElement* link) {
  std::vector<FixedLink> fixed;
  CollectFixed(root, link->Attribute("name"), Isometry3d::Identity(), &fixed);
  Vector10d rest = total.ToVector();
  for (const FixedLink& f : fixed) {
    const XMLElement* inertial = f.element->FirstChildElement("inertial");
    if (inertial == nullptr) continue;
    rest -= ReadInertial(inertial).ReexpressIn(f.X_LC).ToVector();
  }
  const InertialParameters remaining = InertialParameters::FromVector(rest);
  if (WhyUnphysical(remaining).empty()) {
    SetInertial(remaining, link);
    return;
  }
  for (const FixedLink& f : fixed) {
    XMLElement* inertial = f.element->FirstChildElement("inertial");
    if (inertial != nullptr) f.element->DeleteChild(inertial);
  }
  SetInertial(total, link);
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
  root->InsertNewChildElement("link")->SetAttribute("name", "base_link");
  std::string parent = "base_link";
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
    AddJoint((robot.tool_name + "_joint").c_str(), "fixed", parent.c_str(),
             robot.tool_name.c_str(), X_UL * robot.X_LT, root);
  }
  return Print(document);
}

std::string UpdateUrdf(const std::string& path, const Robot& robot,
                       bool geometry) {
  const std::string text = ReadTextFile(path, 32L << 20);
  XMLDocument document;
  if (document.Parse(text.c_str()) != tinyxml2::XML_SUCCESS) {
    throw InputError(path, "", "", "expected the robot's URDF file");
  }
  XMLElement* root = document.FirstChildElement("robot");
  CHECK_NOTNULL(root);
  for (const Link& link : robot.links) {
    XMLElement* element = Find(root, "link", link.name);
    XMLElement* joint = Find(root, "joint", link.joint.name);
    if (element == nullptr || joint == nullptr) {
      throw InputError(path, "", link.name,
                       "expected a link of the robot in its URDF file");
    }
    if (link.inertial.mass > 0) {
      DistributeInertia(link.inertial, root, element);
    }
    SetDynamics(link.joint, joint);
    if (geometry) SetOrigin(link.X_PF * link.X_ML, joint);
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
  if (robot.gravity.head<2>().norm() > 1e-9) {
    losses.push_back(
        "URDF has no field for gravity, which here is not along z");
  }
  return losses;
}

}  // namespace armcal

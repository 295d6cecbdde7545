#include "model/robot_files/urdf_values.h"

#include <tinyxml2.h>

#include <cmath>

#include "model/text/exact_text.h"

namespace armcal {

using Eigen::Isometry3d;
using Eigen::Matrix3d;
using Eigen::Vector3d;
using tinyxml2::XMLElement;

namespace {

// Fixed-axis roll, pitch, yaw: R = Rz(yaw) Ry(pitch) Rx(roll).
Vector3d RollPitchYaw(const Matrix3d& R) {
  return {std::atan2(R(2, 1), R(2, 2)),
          std::atan2(-R(2, 0), std::hypot(R(2, 1), R(2, 2))),
          std::atan2(R(1, 0), R(0, 0))};
}

}  // namespace

std::string Digits(double x) { return ExactText(x); }

std::string Digits(const Vector3d& v) {
  return Digits(v.x()) + " " + Digits(v.y()) + " " + Digits(v.z());
}

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

std::string XmlText(const tinyxml2::XMLDocument& document) {
  tinyxml2::XMLPrinter printer;
  document.Print(&printer);
  return printer.CStr();
}

}  // namespace armcal

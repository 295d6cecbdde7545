#include "model/robot_files/urdf_elements.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "model/robot/robot.h"
#include "model/text/input_text.h"
#include "model/text/xml_element.h"

namespace armcal {
namespace {

using Eigen::Isometry3d;
using Eigen::Matrix3d;
using Eigen::Vector3d;

Isometry3d ReadOrigin(const XmlElement& owner) {
  Isometry3d X = Isometry3d::Identity();
  const std::optional<XmlElement> origin = owner.Child("origin");
  if (!origin) return X;
  if (origin->Has("rpy")) {
    X.linear() = RotationFromRpy(origin->Vector("rpy", "rad"));
  }
  if (origin->Has("xyz")) X.translation() = origin->Vector("xyz", "m");
  return X;
}

// Exporters compute moments of bodies of some m in size to the 16 digits of a
// double, sums of many parts to a few less. A moment (kg m^2) below 0 by no
// more than this, times the largest of the three or the mass (kg) at 1 m, is
// the rounding of 0.
constexpr double kMomentRounding = 1e-14;

Matrix3d ReadInertia(const XmlElement& inertia, double mass) {
  const auto get = [&](const char* name) {
    return inertia.Number(name, "kg m^2");
  };
  const double largest = std::max(
      {std::abs(get("ixx")), std::abs(get("iyy")), std::abs(get("izz"))});
  const auto get_diagonal = [&](const char* name) {
    const double moment = get(name);
    if (std::abs(moment) <= kMomentRounding * std::max(largest, mass)) {
      return std::max(moment, 0.);
    }
    return inertia.NonNegative(name, "kg m^2");
  };
  const double xx = get_diagonal("ixx"), yy = get_diagonal("iyy"),
               zz = get_diagonal("izz");
  const double xy = get("ixy"), xz = get("ixz"), yz = get("iyz");
  Matrix3d I;
  I << xx, xy, xz, xy, yy, yz, xz, yz, zz;
  return I;
}

void ReadInertial(const XmlElement& inertial, TreeLink* link) {
  const double mass = inertial.RequiredChild("mass").NonNegative("value", "kg");
  const Isometry3d X_LI = ReadOrigin(inertial);
  const Matrix3d inertia = ReadInertia(inertial.RequiredChild("inertia"), mass);
  SetInertial(mass, inertia, X_LI, link);
}

void ReadAxis(const XmlElement& element, TreeJoint* joint) {
  const std::optional<XmlElement> axis = element.Child("axis");
  if (!axis) return;  // URDF's default is x
  const Vector3d xyz = axis->Vector("xyz", "");
  if (xyz.stableNorm() < kShortestAxis) {
    axis->Refuse("xyz",
                 JoinNames({NumberText(xyz[0]) + " " + NumberText(xyz[1]) +
                            " " + NumberText(xyz[2])}),
                 "expected an axis that is not zero");
  }
  SetAxis(xyz, joint);
}

// Exporters write 0 where they do not know a limit, so 0 is no limit.
double ReadPositiveLimit(const XmlElement& limit, const char* attribute,
                         const std::string& unit, TreeJoint* joint) {
  constexpr double kNone = std::numeric_limits<double>::infinity();
  if (!limit.Has(attribute)) return kNone;
  const double value = limit.NonNegative(attribute, unit);
  if (value > 0) return value;
  joint->notes.push_back("joint " + Quoted(joint->joint.name) + " has the " +
                         attribute + " limit 0, read as not given");
  return kNone;
}

void ReadPositionLimits(const XmlElement& limit, TreeJoint* joint) {
  const std::string unit = PositionUnit(joint->joint.type);
  const bool has_lower = limit.Has("lower"), has_upper = limit.Has("upper");
  // URDF: an absent one is 0, and a continuous joint has neither.
  const double lower = has_lower ? limit.Number("lower", unit) : 0;
  const double upper = has_upper ? limit.Number("upper", unit) : 0;
  if (joint->joint.type == JointType::kContinuous) return;
  if (lower > upper) {
    const char* attribute = has_lower ? "lower" : "upper";
    limit.Refuse(attribute, limit.Text(attribute),
                 has_lower
                     ? "expected at most the upper limit " + NumberText(upper)
                     : "expected at least the lower limit 0");
  }
  if (lower == upper) {
    joint->notes.push_back("joint " + Quoted(joint->joint.name) +
                           " has equal lower and upper limits, read as none");
    return;
  }
  joint->joint.lower = lower;
  joint->joint.upper = upper;
}

void ReadLimit(const XmlElement& element, TreeJoint* joint) {
  const JointType type = joint->joint.type;
  const std::optional<XmlElement> limit = element.Child("limit");
  if (limit) {
    const std::string speed_unit = std::string(PositionUnit(type)) + "/s";
    joint->joint.velocity =
        ReadPositiveLimit(*limit, "velocity", speed_unit, joint);
    joint->joint.effort =
        ReadPositiveLimit(*limit, "effort", EffortUnit(type), joint);
    ReadPositionLimits(*limit, joint);
  } else if (type != JointType::kContinuous) {
    joint->notes.push_back("joint " + Quoted(joint->joint.name) +
                           " has no limits");
  }
}

void ReadDynamics(const XmlElement& element, Joint* joint) {
  const std::optional<XmlElement> dynamics = element.Child("dynamics");
  if (!dynamics) return;
  const std::string unit = EffortUnit(joint->type);
  if (dynamics->Has("damping")) {
    joint->viscous = dynamics->NonNegative(
        "damping", unit + " s/" + PositionUnit(joint->type));
  }
  if (dynamics->Has("friction")) {
    joint->coulomb = dynamics->NonNegative("friction", unit);
  }
}

void ReadType(const XmlElement& element, TreeJoint* joint) {
  joint->type = element.Name("type");
  for (const JointType type :
       {JointType::kRevolute, JointType::kContinuous, JointType::kPrismatic}) {
    if (joint->type != JointTypeName(type)) continue;
    joint->joint.type = type;
    joint->is_supported = true;
  }
  joint->is_fixed = joint->type == "fixed";
  if (joint->is_supported || joint->is_fixed || joint->type == "floating" ||
      joint->type == "planar") {
    return;
  }
  element.Refuse("type", joint->type,
                 "expected revolute, continuous, prismatic, fixed, floating or "
                 "planar");
}

void ReadMotion(const XmlElement& element, TreeJoint* joint) {
  joint->X_PJ = ReadOrigin(element);
  // Exporters write zero axes and limits to fixed joints, where they mean
  // nothing.
  if (!joint->is_supported) return;
  ReadAxis(element, joint);
  ReadLimit(element, joint);
  ReadDynamics(element, &joint->joint);
}

int ReadLinkOfJoint(const XmlElement& element, const char* tag,
                    const std::vector<TreeLink>& links,
                    const LinkIndex& index) {
  const XmlElement end = element.RequiredChild(tag);
  const std::string name = end.Name("link");
  const auto found = index.find(name);
  if (found == index.end()) {
    end.Refuse("link", name, "expected one of the links " + LinkNames(links));
  }
  return found->second;
}

}  // namespace

TreeLink ReadUrdfLink(XmlElement element) {
  TreeLink link;
  link.name = element.Name("name");
  link.line = element.line();
  element.SetOwner("link " + Quoted(link.name));
  try {
    if (const auto inertial = element.Child("inertial")) {
      ReadInertial(*inertial, &link);
    }
  } catch (const InputError& error) {
    link.error = error;
  }
  return link;
}

TreeJoint ReadUrdfJoint(XmlElement element, const std::vector<TreeLink>& links,
                        const LinkIndex& index) {
  TreeJoint joint;
  joint.joint.name = element.Name("name");
  joint.line = element.line();
  element.SetOwner("joint " + Quoted(joint.joint.name));
  ReadType(element, &joint);
  joint.parent = ReadLinkOfJoint(element, "parent", links, index);
  joint.child = ReadLinkOfJoint(element, "child", links, index);
  try {
    ReadMotion(element, &joint);
  } catch (const InputError& error) {
    joint.error = error;
  }
  return joint;
}

}  // namespace armcal

#include "model/robot_files/mjcf/mjcf_gears.h"

#include "model/robot_files/mjcf/mjcf_joint.h"

namespace armcal {
namespace {

using Eigen::Vector3d;

constexpr double kSameAxis = 1e-9;

void AddJointsNamedIn(const XmlElement& element, std::set<std::string>* names) {
  for (const char* attribute : {"joint", "joint1", "joint2", "jointinparent"}) {
    if (element.Has(attribute)) names->insert(element.Text(attribute));
  }
  for (const XmlElement& child : element.Children(nullptr)) {
    AddJointsNamedIn(child, names);
  }
}

bool IsOnSameAxis(const MjcfElement& a, const MjcfElement& b) {
  const Vector3d z = Vector3d::UnitZ(), origin = Vector3d::Zero();
  return a.Text("type") == b.Text("type") &&
         a.VectorOr("axis", "", z)
             .isApprox(b.VectorOr("axis", "", z), kSameAxis) &&
         (a.VectorOr("pos", "m", origin) - b.VectorOr("pos", "m", origin))
                 .norm() <= kSameAxis;
}

}  // namespace

MjcfGears::MjcfGears(const XmlElement& root) {
  for (const char* section : {"actuator", "tendon", "equality"}) {
    for (const XmlElement& element : root.Children(section)) {
      AddJointsNamedIn(element, &in_use_);
    }
  }
}

bool MjcfGears::IsGear(const MjcfPart& motor, const MjcfPart& gear,
                       const MjcfDefaults& defaults,
                       const MjcfSettings& settings) const {
  if (gear.element.tag() != "joint" || motor.element.tag() != "joint") {
    return false;
  }
  if (!gear.element.Has("name") ||
      in_use_.count(gear.element.Text("name")) > 0 ||
      motor.X_BF.matrix() != gear.X_BF.matrix()) {
    return false;
  }
  const MjcfElement of_motor = defaults.Of(motor.element, motor.childclass);
  const MjcfElement of_gear = defaults.Of(gear.element, gear.childclass);
  return IsOnSameAxis(of_motor, of_gear) &&
         (of_gear.Has("stiffness") ||
          IsMjcfLimited(of_gear, "limited", "range", settings));
}

MjcfGears::Joints MjcfGears::Split(const std::vector<MjcfPart>& parts,
                                   const MjcfDefaults& defaults,
                                   const MjcfSettings& settings) const {
  Joints joints;
  for (const MjcfPart& part : parts) {
    const std::string& tag = part.element.tag();
    if (tag != "joint" && tag != "freejoint") continue;
    const bool yields = !joints.driven.empty() &&
                        IsGear(*joints.driven.back(), part, defaults, settings);
    (yields ? joints.gears : joints.driven).push_back(&part);
  }
  return joints;
}

}  // namespace armcal

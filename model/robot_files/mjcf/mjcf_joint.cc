#include "model/robot_files/mjcf/mjcf_joint.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "model/robot_files/mjcf/mjcf_pose.h"
#include "model/text/input_text.h"

namespace armcal {
namespace {

using Eigen::AngleAxisd;
using Eigen::Isometry3d;
using Eigen::Matrix3d;
using Eigen::Translation3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

void ReadType(const MjcfElement& element, TreeJoint* joint) {
  joint->type =
      element.own().tag() == "freejoint"
          ? "free"
          : element.Choice("type", {"hinge", "slide", "ball", "free"});
  joint->is_supported = joint->type == "hinge" || joint->type == "slide";
  if (joint->type == "slide") joint->joint.type = JointType::kPrismatic;
}

void ReadAxis(const MjcfElement& element, const Matrix3d& R_BF,
              TreeJoint* joint) {
  const Vector3d axis = element.VectorOr("axis", "", Vector3d::UnitZ());
  if (axis.stableNorm() < kShortestAxis) {
    const XmlElement& holder = element.HolderOf("axis");
    holder.Refuse("axis", holder.Text("axis"),
                  "expected an axis that is not zero");
  }
  SetAxis(R_BF * axis, joint);
}

// A hinge without limits is a continuous joint.
void ReadLimits(const MjcfElement& element, const MjcfSettings& settings,
                TreeJoint* tree_joint) {
  Joint& joint = tree_joint->joint;
  const bool hinge = tree_joint->type == "hinge";
  if (IsMjcfLimited(element, "limited", "range", settings)) {
    const Vector2d range = element.Range("range", PositionUnit(joint.type));
    joint.lower = hinge ? MjcfAngle(range[0], settings) : range[0];
    joint.upper = hinge ? MjcfAngle(range[1], settings) : range[1];
    if (range[0] < range[1]) return;
    const XmlElement& holder = element.HolderOf("range");
    holder.Refuse("range", holder.Text("range"),
                  "expected a lower limit below the upper one");
  }
  if (hinge) joint.type = JointType::kContinuous;
}

void ReadEffort(const MjcfElement& element, const MjcfSettings& settings,
                Joint* joint) {
  if (!IsMjcfLimited(element, "actuatorfrclimited", "actuatorfrcrange",
                     settings)) {
    return;
  }
  const Vector2d range =
      element.Range("actuatorfrcrange", EffortUnit(joint->type));
  const double effort = range.cwiseAbs().maxCoeff();
  if (effort > 0) joint->effort = effort;
}

// The linear one of up to three coefficients.
double ReadDamping(const MjcfElement& element, const std::string& unit,
                   TreeJoint* joint) {
  const std::string text = element.Text("damping");
  const auto words = SplitWords(text);
  if (words.size() < 2) return element.NonNegativeOr0("damping", unit);
  const XmlElement& holder = element.HolderOf("damping");
  for (const std::string_view word : words) {
    if (std::isfinite(ParseNumber(word).value_or(INFINITY))) continue;
    holder.Refuse("damping", text, "expected numbers");
  }
  joint->notes.push_back("of the damping of joint " +
                         Quoted(joint->joint.name) +
                         " the linear part is used alone");
  return std::max(0., *ParseNumber(words.front()));
}

void ReadDynamics(const MjcfElement& element, TreeJoint* tree_joint) {
  Joint& joint = tree_joint->joint;
  const std::string unit = EffortUnit(joint.type);
  const std::string position = PositionUnit(joint.type);
  joint.viscous = ReadDamping(element, unit + " s/" + position, tree_joint);
  joint.coulomb = element.NonNegativeOr0("frictionloss", unit);
  joint.armature = element.NonNegativeOr0(
      "armature", IsRotational(joint.type) ? "kg m^2" : "kg");
  const double stiffness =
      element.NumberOr("stiffness", unit + "/" + position, 0);
  if (stiffness == 0 && !element.Has("springdamper")) return;
  tree_joint->notes.push_back("the spring of joint " + Quoted(joint.name) +
                              " is not used: armcal's joints have none");
}

void ReadMotion(const MjcfElement& element, const Isometry3d& X_BF,
                const MjcfSettings& settings, TreeJoint* joint) {
  ReadAxis(element, X_BF.linear(), joint);
  const Vector3d p = X_BF * element.VectorOr("pos", "m", Vector3d::Zero());
  const double ref = element.NumberOr("ref", "", 0);
  joint->X_PJ = joint->X_PJ * Translation3d(p);
  if (joint->type == "hinge") {
    joint->X_PJ.rotate(AngleAxisd(-MjcfAngle(ref, settings), joint->axis));
  } else {
    joint->X_PJ.translate(-ref * joint->axis);
  }
  joint->X_JL.translation() = -p;
  ReadLimits(element, settings, joint);
  ReadEffort(element, settings, &joint->joint);
  ReadDynamics(element, joint);
}

}  // namespace

bool IsMjcfLimited(const MjcfElement& element, const char* limited,
                   const char* range, const MjcfSettings& settings) {
  const std::string choice = element.Choice(limited, {"auto", "true", "false"});
  if (choice != "auto") return choice == "true";
  return settings.autolimits && element.Has(range);
}

TreeJoint ReadMjcfJoint(const MjcfElement& element, const Isometry3d& X_PB,
                        const Isometry3d& X_BF, const std::string& name,
                        const MjcfSettings& settings) {
  TreeJoint joint;
  joint.joint.name = name;
  joint.line = element.own().line();
  ReadType(element, &joint);
  joint.X_PJ = X_PB;
  if (!joint.is_supported) return joint;
  try {
    ReadMotion(element, X_BF, settings, &joint);
  } catch (const InputError& error) {
    joint.error = error;
  }
  return joint;
}

}  // namespace armcal

#include "model/robot_files/mjcf/mjcf_actuators.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <string>

#include "model/robot_files/mjcf/mjcf_joint.h"
#include "model/text/input_text.h"

namespace armcal {
namespace {

using Eigen::Vector2d;

std::string NameOf(const XmlElement& element) {
  return "<" + element.tag() + ">" +
         (element.Has("name") ? " " + Quoted(element.Text("name")) : "");
}

TreeJoint* FindJoint(const XmlElement& element, const char* attribute,
                     RobotTree* tree) {
  const std::string name = element.Name(attribute);
  std::vector<std::string> names;
  for (TreeJoint& joint : tree->joints) {
    if (joint.is_fixed) continue;
    if (joint.joint.name == name) return &joint;
    names.push_back(joint.joint.name);
  }
  element.Refuse(attribute, name,
                 "expected one of the joints " + JoinNames(names));
}

double FirstNumber(const MjcfElement& element, const char* attribute,
                   double absent) {
  if (!element.Has(attribute)) return absent;
  const std::string text = element.Text(attribute);
  const auto words = SplitWords(text);
  const auto number = words.empty() ? std::nullopt : ParseNumber(words.front());
  if (number && std::isfinite(*number)) return *number;
  element.HolderOf(attribute).Refuse(attribute, text, "expected numbers");
}

// Torque in proportion to the control, but for a constant.
bool IsMotor(const MjcfElement& element) {
  if (element.own().tag() == "motor") return true;
  if (element.own().tag() != "general") return false;
  if (element.Has("gaintype") && element.Text("gaintype") != "fixed") {
    return false;
  }
  if (element.Has("dyntype") && element.Text("dyntype") != "none") return false;
  if (!element.Has("biastype") || element.Text("biastype") == "none") {
    return true;
  }
  const std::string bias = element.Text("biasprm");
  const auto words = SplitWords(bias);
  for (size_t i = 1; i < words.size(); ++i) {
    if (ParseNumber(words[i]).value_or(1) != 0) return false;
  }
  return element.Text("biastype") == "affine";
}

// A constant torque, whatever the control.
bool IsConstant(const MjcfElement& element) {
  return element.own().tag() == "general" && IsMotor(element) &&
         element.Has("gainprm") && FirstNumber(element, "gainprm", 1) == 0;
}

// The part of a joint's friction that falls with velocity, without a gain: its
// torque is along the velocity, up to a limit.
bool ReadPush(const MjcfElement& element, TreeJoint* tree_joint) {
  if (element.own().tag() != "general" ||
      element.Text("biastype") != "affine" || !element.Has("gainprm") ||
      FirstNumber(element, "gainprm", 1) != 0 || !element.Has("forcerange")) {
    return false;
  }
  const std::string bias = element.Text("biasprm");
  const auto words = SplitWords(bias);
  if (words.size() < 3 || FirstNumber(element, "biasprm", 0) != 0 ||
      !(ParseNumber(words[2]).value_or(0) > 0)) {
    return false;
  }
  const Vector2d range = element.Range("forcerange", "");
  const double gear = std::abs(FirstNumber(element, "gear", 1));
  double* const coulomb = &tree_joint->joint.coulomb;
  *coulomb = std::max(0., *coulomb - gear * range.cwiseAbs().maxCoeff());
  tree_joint->notes.push_back("actuator " + NameOf(element.own()) +
                              ", which pushes along the velocity, is taken off "
                              "the dry friction of its joint");
  return true;
}

// Friction and ripple of a motor, without a control. Of bristles what a joint
// that moves on has of them, which is dry friction.
bool ReadPassive(const MjcfElement& element, TreeJoint* tree_joint) {
  if (element.own().tag() != "dcmotor" || element.Text("input") != "none") {
    return false;
  }
  const std::string text = element.Text("lugre");
  const auto words = SplitWords(text);
  if (words.size() > 2) {
    const auto coulomb = ParseNumber(words[2]);
    if (!coulomb || !std::isfinite(*coulomb) || *coulomb < 0) {
      element.HolderOf("lugre").Refuse("lugre", text,
                                       "expected numbers, none below 0");
    }
    tree_joint->joint.coulomb += *coulomb;
  }
  tree_joint->notes.push_back(
      "of actuator " + NameOf(element.own()) +
      ", which has no control, armcal has no more than dry friction");
  return true;
}

// N m or N at the joint, in both directions.
std::optional<Vector2d> EffortRange(const MjcfElement& element, double gear,
                                    const MjcfSettings& settings) {
  const auto of = [&](const char* limited, const char* range,
                      double factor) -> std::optional<Vector2d> {
    if (!IsMjcfLimited(element, limited, range, settings)) return std::nullopt;
    const Vector2d limits = element.Range(range, "") * factor;
    return limits.isZero(0) ? std::nullopt : std::make_optional(limits);
  };
  if (const auto force = of("forcelimited", "forcerange", gear)) return force;
  if (!IsMotor(element)) return std::nullopt;
  const bool general = element.own().tag() == "general";
  const double gain = general ? FirstNumber(element, "gainprm", 1) : 1;
  return of("ctrllimited", "ctrlrange", gear * gain);
}

void ReadActuator(const MjcfElement& element, const MjcfSettings& settings,
                  TreeJoint* tree_joint) {
  Joint& joint = tree_joint->joint;
  for (const char* of_joint : {"armature", "damping"}) {
    if (FirstNumber(element, of_joint, 0) == 0) continue;
    element.HolderOf(of_joint).Refuse(of_joint, element.Text(of_joint),
                                      "expected it of the joint");
  }
  const double gear = FirstNumber(element, "gear", 1);
  if (const auto range = EffortRange(element, gear, settings)) {
    joint.effort = std::min(joint.effort, range->cwiseAbs().maxCoeff());
    if (std::abs(range->sum()) > 1e-9 * range->norm()) {
      tree_joint->notes.push_back(
          "the effort of joint " + Quoted(joint.name) +
          " is limited unevenly: the larger limit is taken");
    }
  }
  if (element.own().tag() != "general" || !IsMotor(element)) return;
  if (element.Text("biastype") != "affine") return;
  joint.offset = -gear * FirstNumber(element, "biasprm", 0);
}

}  // namespace

void ReadMjcfActuators(const XmlElement& root, const MjcfDefaults& defaults,
                       const MjcfSettings& settings, RobotTree* tree) {
  std::set<TreeJoint*> driven;
  std::map<TreeJoint*, double> constants;
  for (const XmlElement& section : root.Children("actuator")) {
    for (const XmlElement& element : section.Children(nullptr)) {
      const char* attribute =
          element.Has("jointinparent") ? "jointinparent" : "joint";
      if (!element.Has(attribute)) {
        tree->notes.push_back("not used, as it acts on no joint: actuator " +
                              NameOf(element));
        continue;
      }
      TreeJoint* joint = FindJoint(element, attribute, tree);
      const MjcfElement actuator = defaults.OfActuator(element);
      if (ReadPassive(actuator, joint) || ReadPush(actuator, joint)) continue;
      if (IsConstant(actuator)) {
        constants[joint] -= FirstNumber(actuator, "gear", 1) *
                            FirstNumber(actuator, "biasprm", 0);
        continue;
      }
      if (!driven.insert(joint).second) {
        joint->notes.push_back("joint " + Quoted(joint->joint.name) +
                               " has several actuators: its effort is not "
                               "limited by them");
        joint->joint.effort = std::numeric_limits<double>::infinity();
        joint->joint.offset = 0;
        continue;
      }
      ReadActuator(actuator, settings, joint);
    }
  }
  for (const auto& [joint, offset] : constants) joint->joint.offset += offset;
}

}  // namespace armcal

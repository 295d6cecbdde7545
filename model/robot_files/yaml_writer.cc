#include "model/robot_files/yaml_writer.h"

#include <cmath>

#include "model/robot/dh_row.h"
#include "model/text/exact_text.h"
#include "model/text/format.h"

namespace armcal {
namespace {

using Eigen::Isometry3d;
using Eigen::Matrix3d;

// Names may hold anything but control characters.
std::string Name(const std::string& name) {
  std::string text = "\"";
  for (const char c : name) {
    if (c == '"' || c == '\\') text += '\\';
    text += c;
  }
  return text + "\"";
}

template <typename Numbers>
std::string List(const Numbers& numbers) {
  std::string text;
  for (const double x : numbers) {
    text += (text.empty() ? "[" : ", ") + ExactText(x);
  }
  return text + "]";
}

std::string Names(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) {
    text += (text.empty() ? "[" : ", ") + name;
  }
  return text + "]";
}

std::string Pose(const Isometry3d& X) {
  const Eigen::Vector3d p = X.translation();
  std::string text =
      "{xyz: " + List(std::vector<double>(p.data(), p.data() + 3));
  if (X.linear() != Matrix3d::Identity()) {
    const Matrix3d columns = X.linear().transpose();  // rows, as they lie
    text += ", rotation: " +
            List(std::vector<double>(columns.data(), columns.data() + 9));
  }
  return text + "}";
}

void AddIf(bool wanted, const char* key, double value, std::string* text) {
  if (!wanted) return;
  *text += "    " + std::string(key) + ": " + ExactText(value) + "\n";
}

void AddLimits(const Joint& joint, std::string* text) {
  std::string limits;
  const auto add = [&](const char* key, double value) {
    if (!std::isfinite(value)) return;
    limits += (limits.empty() ? "" : ", ") + std::string(key) + ": " +
              ExactText(value);
  };
  if (joint.type != JointType::kContinuous) {
    add("lower", joint.lower);
    add("upper", joint.upper);
  }
  add("velocity", joint.velocity);
  add("effort", joint.effort);
  if (!limits.empty()) *text += "    limits: {" + limits + "}\n";
}

void AddPlace(const Link& link, const std::optional<DhConvention>& convention,
              std::string* text) {
  if (!convention) {
    *text += "    pose: " + Pose(link.X_PF) + "\n";
    if (link.X_ML.matrix() != Isometry3d::Identity().matrix()) {
      *text += "    link_pose: " + Pose(link.X_ML) + "\n";
    }
    return;
  }
  const DhParameters dh = *DhRow(link, *convention);
  for (const auto& [key, value] :
       {std::make_pair("a", dh.a), std::make_pair("d", dh.d),
        std::make_pair("alpha", dh.alpha), std::make_pair("theta", dh.theta)}) {
    AddIf(value != 0, key, value, text);
  }
  if (!link.unknown_lengths.empty()) {
    *text += "    unknown: " + Names(link.unknown_lengths) + "\n";
  }
}

void AddBody(const Link& link, std::string* text) {
  if (link.has_inertial || link.inertial.mass != 0) {
    const Vector10d V = link.inertial.ToVector();
    const Eigen::Vector3d com = link.inertial.first_moment / link.inertial.mass;
    *text += "    inertial: " +
             List(std::vector<double>(V.data(), V.data() + V.size())) +
             Format("  # centre of mass %.6g %.6g %.6g m\n", com.x(), com.y(),
                    com.z());
  }
  if (!link.zero_inertials.empty()) {
    *text += "    zero: " + Names(link.zero_inertials) + "\n";
  }
}

void AddLink(const Robot& robot, int i,
             const std::optional<DhConvention>& convention, std::string* text) {
  const Link& link = robot.links[i];
  const Joint& joint = link.joint;
  *text += "  - name: " + Name(link.name) + "\n";
  const int parent = robot.parent(i);
  if (parent != i - 1) {
    *text += "    parent: " +
             (parent < 0 ? "base" : Name(robot.links[parent].name)) + "\n";
  }
  *text += "    joint: " + std::string(JointTypeName(joint.type)) + "\n";
  *text += "    joint_name: " + Name(joint.name) + "\n";
  AddPlace(link, convention, text);
  AddBody(link, text);
  AddLimits(joint, text);
  AddIf(joint.viscous != 0, "viscous", joint.viscous, text);
  AddIf(joint.coulomb != 0, "coulomb", joint.coulomb, text);
  AddIf(joint.armature != 0, "armature", joint.armature, text);
  AddIf(joint.offset != 0, "offset", joint.offset, text);
}

// The table's convention where every link still is a row of it.
std::optional<DhConvention> ConventionOf(const Robot& robot) {
  if (!robot.dh_convention) return std::nullopt;
  for (const Link& link : robot.links) {
    if (!DhRow(link, *robot.dh_convention)) return std::nullopt;
  }
  return robot.dh_convention;
}

}  // namespace

std::string MakeYaml(const RobotDescription& description) {
  const Robot& robot = description.robot;
  const auto convention = ConventionOf(robot);
  const Eigen::Vector3d& g = robot.gravity;
  std::string text = "name: " + Name(robot.name) + "\n";
  text +=
      "gravity: " + List(std::vector<double>(g.data(), g.data() + 3)) + "\n";
  text += "convention: ";
  text += !convention                              ? "poses\n"
          : *convention == DhConvention::kStandard ? "standard\n"
                                                   : "modified\n";
  text += "links:\n";
  for (int i = 0; i < robot.num_joints(); ++i) {
    AddLink(robot, i, convention, &text);
  }
  if (!robot.tool_name.empty()) {
    text += "tool: {name: " + Name(robot.tool_name) +
            ", pose: " + Pose(robot.X_LT) + "}\n";
  }
  return text;
}

RobotFormat YamlFormat() {
  return {"yaml",
          "YAML",
          "robot.yaml",
          {RobotField::kSpring, RobotField::kGain, RobotField::kTorqueLimit,
           RobotField::kTorqueLimitSlope, RobotField::kLaws,
           RobotField::kController},
          &MakeYaml,
          nullptr,
          true,
          true};
}

}  // namespace armcal

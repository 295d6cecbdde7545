#include "calib/inspect/robot_description.h"

#include <cmath>

#include "calib/numerics/json_figures.h"
#include "model/robot/kinematics.h"
#include "model/text/format.h"

namespace armcal {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using nlohmann::json;

Vector3d CenterOf(const Link& link) {
  return link.inertial.first_moment / link.inertial.mass;
}

// A vector of which rounding is not shown.
std::string VectorText(const Vector3d& v) {
  std::string text;
  for (int i = 0; i < 3; ++i) {
    const double x = std::abs(v[i]) < 5e-7 ? 0 : v[i];
    text += Format(i == 0 ? "%.4g" : " %.4g", x);
  }
  return text;
}

std::string LimitsText(const Joint& joint) {
  const std::string unit = PositionUnit(joint.type);
  std::string text =
      std::isfinite(joint.lower) || std::isfinite(joint.upper)
          ? Format("%.4g to %.4g %s", joint.lower, joint.upper, unit.c_str())
          : "no position limits";
  if (std::isfinite(joint.velocity)) {
    text += Format(", %.4g %s/s", joint.velocity, unit.c_str());
  }
  if (std::isfinite(joint.effort)) {
    text += Format(", %.4g %s", joint.effort, EffortUnit(joint.type));
  }
  return text;
}

std::string TermsText(const Joint& joint) {
  std::string text;
  const auto add = [&](const char* name, double value) {
    if (value == 0) return;
    text += Format("%s%s %.4g", text.empty() ? "" : ", ", name, value);
  };
  add("viscous", joint.viscous);
  add("Coulomb", joint.coulomb);
  add("armature", joint.armature);
  add("offset", joint.offset);
  return text.empty() ? "no friction or armature" : text;
}

std::string LinkText(const Link& link) {
  if (IsDeclaredMassless(link)) return "no mass: it joins joints of one body";
  if (!link.has_inertial) return "no inertia in the file";
  return Format("%.4g kg, centre at ", link.inertial.mass) +
         VectorText(CenterOf(link)) + " m";
}

json Numbers(const Vector3d& v) {
  return {JsonNumber(v[0]), JsonNumber(v[1]), JsonNumber(v[2])};
}

}  // namespace

std::vector<Vector3d> AxesAtZero(const Robot& robot) {
  std::vector<Vector3d> axes;
  const std::vector<Isometry3d> X_WL =
      LinkPoses(robot, Eigen::VectorXd::Zero(robot.num_joints()));
  for (int j = 0; j < robot.num_joints(); ++j) {
    const int parent = robot.parent(j);
    const Isometry3d& X_PF = robot.links[j].X_PF;
    axes.push_back((parent < 0 ? X_PF : X_WL[parent] * X_PF).linear().col(2));
  }
  return axes;
}

std::string DescriptionText(const Robot& robot) {
  const std::vector<Vector3d> axes = AxesAtZero(robot);
  std::string text;
  for (int j = 0; j < robot.num_joints(); ++j) {
    const Link& link = robot.links[j];
    const int parent = robot.parent(j);
    if (parent != j - 1) {
      text += "  on " + (parent < 0 ? "the base" : robot.links[parent].name) +
              ":\n";
    }
    text += Format("  %d %s: %s, axis ", j + 1, link.joint.name.c_str(),
                   JointTypeName(link.joint.type)) +
            VectorText(axes[j]) + ", " + LimitsText(link.joint) + "; " +
            TermsText(link.joint) + "\n    moves " + link.name + ": " +
            LinkText(link) + "\n";
  }
  text +=
      "  gravity " + VectorText(robot.gravity) + " m/s^2 in the base's frame";
  if (!robot.tool_name.empty()) text += "; tool " + robot.tool_name;
  return text + "\n";
}

json DescriptionJson(const Robot& robot) {
  const std::vector<Vector3d> axes = AxesAtZero(robot);
  json joints = json::array(), links = json::array();
  for (int j = 0; j < robot.num_joints(); ++j) {
    const Link& link = robot.links[j];
    const Joint& joint = link.joint;
    joints.push_back({{"name", joint.name},
                      {"type", JointTypeName(joint.type)},
                      {"axis", Numbers(axes[j])},
                      {"lower", JsonNumber(joint.lower)},
                      {"upper", JsonNumber(joint.upper)},
                      {"velocity", JsonNumber(joint.velocity)},
                      {"effort", JsonNumber(joint.effort)},
                      {"viscous", JsonNumber(joint.viscous)},
                      {"coulomb", JsonNumber(joint.coulomb)},
                      {"armature", JsonNumber(joint.armature)},
                      {"offset", JsonNumber(joint.offset)}});
    const int parent = robot.parent(j);
    links.push_back({{"name", link.name},
                     {"parent", parent < 0 ? "" : robot.links[parent].name},
                     {"mass", nullptr},
                     {"com", nullptr}});
    if (!link.has_inertial) continue;
    links.back()["mass"] = JsonNumber(link.inertial.mass);
    links.back()["com"] = Numbers(CenterOf(link));
  }
  return {{"name", robot.name},      {"joints", joints},
          {"links", links},          {"gravity", Numbers(robot.gravity)},
          {"tool", robot.tool_name}, {"held", robot.held},
          {"notes", robot.notes}};
}

}  // namespace armcal

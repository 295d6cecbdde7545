#include "model/robot_files/urdf_writer.h"

#include <tinyxml2.h>

#include <cmath>

#include "model/robot_files/new_name.h"
#include "model/robot_files/urdf_values.h"
#include "model/text/format.h"

namespace armcal {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using tinyxml2::XMLDocument;
using tinyxml2::XMLElement;

// Where the robot has no limit: wide ones, as URDF requires the attributes.
constexpr double kWholeTurn = 6.28318530717958648;  // rad, or m
constexpr double kWideEffort = 1e6;                 // N m, or N
constexpr double kWideVelocity = 1e3;               // rad/s, or m/s

void SetLimits(const Joint& joint, XMLElement* element) {
  const auto or_wide = [](double x, double wide) {
    return Digits(std::isfinite(x) ? x : wide);
  };
  XMLElement* limit = Child(element, "limit");
  if (joint.type != JointType::kContinuous) {
    limit->SetAttribute("lower", or_wide(joint.lower, -kWholeTurn).c_str());
    limit->SetAttribute("upper", or_wide(joint.upper, kWholeTurn).c_str());
  }
  limit->SetAttribute("effort", or_wide(joint.effort, kWideEffort).c_str());
  limit->SetAttribute("velocity",
                      or_wide(joint.velocity, kWideVelocity).c_str());
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

// A URDF link's frame U is its joint's frame. Where the link's own frame L lies
// on the joint's axis at 0, U = L; else, as of standard DH links, which turn
// about the axis before them, U = M, and L is a link of its own that is fixed
// to this one.
bool StandsAtJoint(const Link& link) {
  return link.X_ML.translation().norm() < 1e-12;
}

Isometry3d UrdfFrame(const Link& link) {
  return StandsAtJoint(link) ? link.X_ML : Isometry3d::Identity();  // X_MU
}

Isometry3d InUrdfFrame(const Link& link) {  // X_UL
  return UrdfFrame(link).inverse() * link.X_ML;
}

// The name of what stands where the link's own frame is. The link that moves
// keeps the source's name, by which joints, tips and results refer to it.
std::string FrameName(const Robot& robot, const Link& link) {
  return StandsAtJoint(link) ? link.name : NewName(robot, link.name + "_frame");
}

// Adds a link without inertia, fixed at X on link `parent`.
void AddUrdfFrame(const Robot& robot, const std::string& name,
                  const std::string& parent, const Isometry3d& X,
                  XMLElement* root) {
  root->InsertNewChildElement("link")->SetAttribute("name", name.c_str());
  AddJoint(NewName(robot, name + "_joint").c_str(), "fixed", parent.c_str(),
           name.c_str(), X, root);
}

// Adds link i, its joint on `base` or the link before it, and its own frame
// where that is not the joint's.
void AddUrdfLink(const Robot& robot, int i, const std::string& base,
                 XMLElement* root) {
  const Link& link = robot.links[i];
  const int before = robot.parent(i);
  const std::string& parent = before < 0 ? base : robot.links[before].name;
  const Isometry3d X_UL =
      before < 0 ? Isometry3d::Identity() : InUrdfFrame(robot.links[before]);
  const Isometry3d X_MU = UrdfFrame(link);
  XMLElement* element = root->InsertNewChildElement("link");
  element->SetAttribute("name", link.name.c_str());
  if (link.inertial.mass > 0) {
    SetInertial(link.inertial.ReexpressIn(InUrdfFrame(link)), element);
  }
  XMLElement* joint = AddJoint(
      link.joint.name.c_str(), JointTypeName(link.joint.type), parent.c_str(),
      link.name.c_str(), X_UL * link.X_PF * X_MU, root);
  const Vector3d axis = X_MU.linear().transpose() * Vector3d::UnitZ();
  Child(joint, "axis")->SetAttribute("xyz", Digits(axis).c_str());
  SetLimits(link.joint, joint);
  SetDynamics(link.joint, joint);
  if (StandsAtJoint(link)) return;
  AddUrdfFrame(robot, FrameName(robot, link), link.name, InUrdfFrame(link),
               root);
}

std::string WriteUrdf(const RobotDescription& description) {
  return MakeUrdf(description.robot);
}

// The names of the joints for which `holds`, with commas between.
template <class Holds>
std::string JointsWhere(const Robot& robot, const Holds& holds) {
  std::string names;
  for (const Link& link : robot.links) {
    if (!holds(link.joint)) continue;
    names += (names.empty() ? "" : ", ") + link.joint.name;
  }
  return names;
}

std::string LimitLoss(const Robot& robot) {
  std::string limits;
  const auto add = [&](const std::string& wide, const std::string& joints) {
    if (joints.empty()) return;
    limits += (limits.empty() ? "" : "; ") + wide + " of " + joints;
  };
  add(Format("effort %.0e", kWideEffort),
      JointsWhere(robot,
                  [](const Joint& j) { return !std::isfinite(j.effort); }));
  add(Format("velocity %.0f", kWideVelocity),
      JointsWhere(robot,
                  [](const Joint& j) { return !std::isfinite(j.velocity); }));
  add(Format("positions within %.4g", kWholeTurn),
      JointsWhere(robot, [](const Joint& j) {
        return j.type != JointType::kContinuous &&
               (!std::isfinite(j.lower) || !std::isfinite(j.upper));
      }));
  if (limits.empty()) return "";
  return "URDF requires limits; where the robot has none they are wide (" +
         limits + ")";
}

// What becomes otherwise in a file that is written anew, a sentence each.
std::vector<std::string> WrittenUrdfLosses(
    const RobotDescription& description) {
  const Robot& robot = description.robot;
  std::vector<std::string> losses;
  const std::string limits = LimitLoss(robot);
  if (!limits.empty()) losses.push_back(limits);
  std::string moved, massless;
  for (const Link& link : robot.links) {
    if (!StandsAtJoint(link)) {
      moved += (moved.empty() ? "" : ", ") + FrameName(robot, link);
    }
    if (link.inertial.mass > 0) continue;
    massless += (massless.empty() ? "" : ", ") + link.name;
  }
  if (!moved.empty()) {
    losses.push_back(
        "URDF has the frames of links at their joints; those that the robot "
        "has elsewhere are links of their own (" +
        moved + ")");
  }
  if (!massless.empty()) {
    losses.push_back("MuJoCo refuses a URDF whose links move without mass (" +
                     massless + ")");
  }
  return losses;
}

}  // namespace

std::string MakeUrdf(const Robot& robot) {
  XMLDocument document;
  document.InsertEndChild(document.NewDeclaration());
  XMLElement* root = document.NewElement("robot");
  root->SetAttribute("name", robot.name.c_str());
  document.InsertEndChild(root);
  const std::string base = NewName(robot, "base_link");
  root->InsertNewChildElement("link")->SetAttribute("name", base.c_str());
  for (int i = 0; i < robot.num_joints(); ++i) {
    AddUrdfLink(robot, i, base, root);
  }
  if (!robot.tool_name.empty()) {
    // On the last link's own frame, so that this is no second end of the chain.
    AddUrdfFrame(robot, robot.tool_name, FrameName(robot, robot.links.back()),
                 robot.X_LT, root);
  }
  return XmlText(document);
}

RobotFormat UrdfFormat() {
  return {"urdf",
          "URDF",
          "robot.urdf",
          {RobotField::kArmature, RobotField::kOffset, RobotField::kSpring,
           RobotField::kGain, RobotField::kTorqueLimit,
           RobotField::kTorqueLimitSlope, RobotField::kLaws,
           RobotField::kGravity, RobotField::kController},
          &WriteUrdf,
          &WrittenUrdfLosses};
}

RobotFormat UpdatedUrdfFormat() {
  RobotFormat format = UrdfFormat();
  format.more_losses = nullptr;
  return format;
}

std::vector<std::string> UrdfLosses(const Robot& robot) {
  return Losses(UrdfFormat(), {robot, {}});
}

}  // namespace armcal

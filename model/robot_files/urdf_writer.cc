#include "model/robot_files/urdf_writer.h"

#include <tinyxml2.h>

#include <cmath>

#include "model/robot_files/new_name.h"
#include "model/robot_files/urdf_values.h"

namespace armcal {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using tinyxml2::XMLDocument;
using tinyxml2::XMLElement;

constexpr double kWholeTurn = 6.28318530717958648;  // rad, or m

// URDF wants limits of a revolute or prismatic joint; where the robot has none
// they are wide.
void SetLimits(const Joint& joint, XMLElement* element) {
  const auto or_wide = [](double x, double wide) {
    return Digits(std::isfinite(x) ? x : wide);
  };
  XMLElement* limit = Child(element, "limit");
  if (joint.type != JointType::kContinuous) {
    limit->SetAttribute("lower", or_wide(joint.lower, -kWholeTurn).c_str());
    limit->SetAttribute("upper", or_wide(joint.upper, kWholeTurn).c_str());
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

// The frame of a link whose joint turns about its own origin: URDF's. Standard
// DH links turn about the axis before them: their frame M stands in for L.
Isometry3d UrdfFrame(const Link& link) {
  const bool on_axis = link.X_ML.translation().norm() < 1e-12;
  return on_axis ? link.X_ML : Isometry3d::Identity();  // X_MU
}

std::string WriteUrdf(const RobotDescription& description) {
  return MakeUrdf(description.robot);
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
  const auto in_urdf = [](const Link& link) -> Isometry3d {  // X_UL
    return UrdfFrame(link).inverse() * link.X_ML;
  };
  for (int i = 0; i < robot.num_joints(); ++i) {
    const Link& link = robot.links[i];
    const int before = robot.parent(i);
    const std::string& parent = before < 0 ? base : robot.links[before].name;
    const Isometry3d X_UL =
        before < 0 ? Isometry3d::Identity() : in_urdf(robot.links[before]);
    const Isometry3d X_MU = UrdfFrame(link);
    XMLElement* element = root->InsertNewChildElement("link");
    element->SetAttribute("name", link.name.c_str());
    if (link.inertial.mass > 0) {
      SetInertial(link.inertial.ReexpressIn(in_urdf(link)), element);
    }
    XMLElement* joint = AddJoint(
        link.joint.name.c_str(), JointTypeName(link.joint.type), parent.c_str(),
        link.name.c_str(), X_UL * link.X_PF * X_MU, root);
    const Vector3d axis = X_MU.linear().transpose() * Vector3d::UnitZ();
    Child(joint, "axis")->SetAttribute("xyz", Digits(axis).c_str());
    SetLimits(link.joint, joint);
    SetDynamics(link.joint, joint);
  }
  if (!robot.tool_name.empty()) {
    root->InsertNewChildElement("link")->SetAttribute("name",
                                                      robot.tool_name.c_str());
    AddJoint(NewName(robot, robot.tool_name + "_joint").c_str(), "fixed",
             robot.links.back().name.c_str(), robot.tool_name.c_str(),
             in_urdf(robot.links.back()) * robot.X_LT, root);
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
          nullptr};
}

std::vector<std::string> UrdfLosses(const Robot& robot) {
  return Losses(UrdfFormat(), {robot, {}});
}

}  // namespace armcal

#include "model/robot_files/sdf_writer.h"

#include <tinyxml2.h>

#include <cmath>

#include "model/robot_files/new_name.h"
#include "model/robot_files/urdf_values.h"
#include "model/text/exact_text.h"

namespace armcal {
namespace {

using Eigen::Isometry3d;
using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;
using tinyxml2::XMLElement;

std::string ThreeNumbers(const Vector3d& v) {
  return ExactText(v.x()) + " " + ExactText(v.y()) + " " + ExactText(v.z());
}

XMLElement* Add(const char* name, const std::string& text, XMLElement* parent) {
  XMLElement* element = parent->InsertNewChildElement(name);
  element->SetText(text.c_str());
  return element;
}

void AddIf(bool wanted, const char* name, double value, XMLElement* parent) {
  if (wanted) Add(name, ExactText(value), parent);
}

// In the frame `relative_to`, else in that of what holds the element.
void AddPose(const Isometry3d& X, const std::string& relative_to,
             XMLElement* parent) {
  const Quaterniond q(X.linear());
  XMLElement* pose =
      Add("pose",
          ThreeNumbers(X.translation()) + " " +
              ThreeNumbers(Vector3d(q.vec())) + " " + ExactText(q.w()),
          parent);
  pose->SetAttribute("rotation_format", "quat_xyzw");
  if (!relative_to.empty()) {
    pose->SetAttribute("relative_to", relative_to.c_str());
  }
}

XMLElement* AddNamed(const char* tag, const std::string& name,
                     XMLElement* parent) {
  XMLElement* element = parent->InsertNewChildElement(tag);
  element->SetAttribute("name", name.c_str());
  return element;
}

// Of a link without mass zeros, which Drake takes: left out, they would be
// SDF's defaults, 1 kg and 1 kg m^2 (SDFormat specification, inertial.sdf).
void AddSdfInertial(const InertialParameters& V, XMLElement* link) {
  Isometry3d X_LI = Isometry3d::Identity();
  if (V.mass > 0) X_LI.translation() = V.first_moment / V.mass;
  const Matrix3d I = V.ReexpressIn(X_LI.inverse()).inertia;
  XMLElement* inertial = link->InsertNewChildElement("inertial");
  AddPose(X_LI, "", inertial);
  Add("mass", ExactText(V.mass), inertial);
  XMLElement* inertia = inertial->InsertNewChildElement("inertia");
  Add("ixx", ExactText(I(0, 0)), inertia);
  Add("ixy", ExactText(I(0, 1)), inertia);
  Add("ixz", ExactText(I(0, 2)), inertia);
  Add("iyy", ExactText(I(1, 1)), inertia);
  Add("iyz", ExactText(I(1, 2)), inertia);
  Add("izz", ExactText(I(2, 2)), inertia);
}

void AddLimits(const Joint& joint, XMLElement* axis) {
  XMLElement* limit = axis->InsertNewChildElement("limit");
  AddIf(std::isfinite(joint.lower), "lower", joint.lower, limit);
  AddIf(std::isfinite(joint.upper), "upper", joint.upper, limit);
  AddIf(std::isfinite(joint.effort), "effort", joint.effort, limit);
  AddIf(std::isfinite(joint.velocity), "velocity", joint.velocity, limit);
}

void AddDynamics(const Joint& joint, const JointDrive& drive,
                 XMLElement* axis) {
  XMLElement* dynamics = axis->InsertNewChildElement("dynamics");
  Add("damping", ExactText(joint.viscous), dynamics);
  Add("friction", ExactText(joint.coulomb), dynamics);
  const bool spring = drive.stiffness != 0;
  AddIf(spring, "spring_reference", drive.rest, dynamics);
  AddIf(spring, "spring_stiffness", drive.stiffness, dynamics);
}

XMLElement* AddJoint(const std::string& name, const char* type,
                     const std::string& parent, const std::string& child,
                     XMLElement* model) {
  XMLElement* joint = AddNamed("joint", name, model);
  joint->SetAttribute("type", type);
  Add("parent", parent, joint);
  Add("child", child, joint);
  return joint;
}

// The joint's frame stands at its axis, parallel to the link's.
void AddLink(const Link& link, const JointDrive& drive,
             const std::string& parent, XMLElement* model) {
  XMLElement* element = AddNamed("link", link.name, model);
  AddPose(link.X_PL(0), parent, element);
  AddSdfInertial(link.inertial.mass > 0 ? link.inertial : InertialParameters(),
                 element);
  XMLElement* joint = AddJoint(link.joint.name, JointTypeName(link.joint.type),
                               parent, link.name, model);
  const Isometry3d X_LM = link.X_ML.inverse();
  Isometry3d X_LJ = Isometry3d::Identity();
  X_LJ.translation() = X_LM.translation();
  AddPose(X_LJ, "", joint);
  XMLElement* axis = joint->InsertNewChildElement("axis");
  Add("xyz", ThreeNumbers(X_LM.linear().col(2)), axis);
  AddLimits(link.joint, axis);
  AddDynamics(link.joint, drive, axis);
  if (link.joint.armature == 0) return;
  Add("drake:rotor_inertia", ExactText(link.joint.armature), joint);
  Add("drake:gear_ratio", "1", joint);
}

std::vector<std::string> SdfLosses(const RobotDescription& description) {
  std::vector<std::string> losses = {
      "SDF leaves gravity to the world, which here is " +
      ThreeNumbers(description.robot.gravity) +
      " m/s^2 (the format's default is -9.8)"};
  for (const Link& link : description.robot.links) {
    if (link.joint.armature == 0) continue;
    losses.push_back(
        "SDF has no field for armature but drake:rotor_inertia, which Drake "
        "alone reads");
    break;
  }
  std::string massless;
  for (const Link& link : description.robot.links) {
    if (link.inertial.mass > 0) continue;
    massless += (massless.empty() ? "" : ", ") + link.name;
  }
  if (!massless.empty()) {
    losses.push_back("links without mass have mass 0 in the file (" + massless +
                     "), as SDF's default is 1 kg; Drake takes that, other "
                     "simulators may not");
  }
  return losses;
}

}  // namespace

std::string MakeSdf(const RobotDescription& description) {
  const Robot& robot = description.robot;
  tinyxml2::XMLDocument document;
  document.InsertEndChild(document.NewDeclaration());
  XMLElement* root = document.NewElement("sdf");
  document.InsertEndChild(root);
  root->SetAttribute("version", "1.9");
  root->SetAttribute("xmlns:drake", "http://drake.mit.edu");
  XMLElement* model = AddNamed("model", robot.name, root);
  const std::string base = NewName(robot, "base_link");
  AddNamed("link", base, model);
  AddJoint(NewName(robot, "base_joint"), "fixed", "world", base, model);
  for (int j = 0; j < robot.num_joints(); ++j) {
    const int before = robot.parent(j);
    AddLink(robot.links[j], description.DriveOf(j),
            before < 0 ? base : robot.links[before].name, model);
  }
  if (!robot.tool_name.empty()) {
    // What a frame is attached to moves it; `relative_to` alone only says where
    // it stands at the zero position (SDFormat, "Pose frame semantics").
    XMLElement* const tool = AddNamed("frame", robot.tool_name, model);
    tool->SetAttribute("attached_to", robot.links.back().name.c_str());
    AddPose(robot.X_LT, robot.links.back().name, tool);
  }
  return XmlText(document);
}

RobotFormat SdfFormat() {
  return {"sdf",
          "SDF",
          "robot.sdf",
          {RobotField::kOffset, RobotField::kGain, RobotField::kTorqueLimit,
           RobotField::kTorqueLimitSlope, RobotField::kLaws,
           RobotField::kController},
          &MakeSdf,
          &SdfLosses};
}

}  // namespace armcal

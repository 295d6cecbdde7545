#include "model/robot_files/mjcf_writer.h"

#include <tinyxml2.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "model/robot_files/mjcf_drive.h"
#include "model/robot_files/mjcf_laws.h"
#include "model/robot_files/urdf_values.h"
#include "model/text/exact_text.h"

namespace armcal {
namespace {

using Eigen::Isometry3d;
using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;
using tinyxml2::XMLElement;

constexpr double kTurn = 6.28318530717958648;  // rad, or m
constexpr double kThin = .02;                  // m, of what is drawn
// MuJoCo takes no smaller moment of a body that moves, kg m^2.
constexpr double kLeastMoment = 1e-14;

std::string Text(const Vector3d& v) {
  return ExactText(v.x()) + " " + ExactText(v.y()) + " " + ExactText(v.z());
}

void Set(const char* name, double value, XMLElement* element) {
  element->SetAttribute(name, ExactText(value).c_str());
}

void SetRange(const char* limited, const char* range, double lower,
              double upper, XMLElement* element) {
  element->SetAttribute(limited, "true");
  element->SetAttribute(range,
                        (ExactText(lower) + " " + ExactText(upper)).c_str());
}

void SetPose(const Isometry3d& X, XMLElement* element) {
  const Quaterniond q(X.linear());
  element->SetAttribute("pos", Text(X.translation()).c_str());
  element->SetAttribute(
      "quat", (ExactText(q.w()) + " " + Text(Vector3d(q.vec()))).c_str());
}

// MuJoCo refuses the rounding of what lies on the edge of what can exist.
Vector3d PossibleMoments(Vector3d moments) {
  moments = moments.cwiseMax(kLeastMoment);
  moments[2] = std::min(moments[2], (moments[0] + moments[1]) * (1 - 1e-15));
  return moments;
}

void AddInertial(const InertialParameters& V, XMLElement* body) {
  const Vector3d com = V.first_moment / V.mass;
  const Matrix3d I =
      V.inertia - V.mass * (com.squaredNorm() * Matrix3d::Identity() -
                            com * com.transpose());
  const Eigen::SelfAdjointEigenSolver<Matrix3d> principal(I);
  Isometry3d X_LI = Isometry3d::Identity();
  X_LI.translation() = com;
  X_LI.linear() = principal.eigenvectors();
  if (X_LI.linear().determinant() < 0) X_LI.linear().col(0) *= -1;
  XMLElement* inertial = body->InsertNewChildElement("inertial");
  SetPose(X_LI, inertial);
  Set("mass", V.mass, inertial);
  inertial->SetAttribute(
      "diaginertia", Text(PossibleMoments(principal.eigenvalues())).c_str());
}

void SetIfAny(const char* name, double value, XMLElement* element) {
  if (value != 0) Set(name, value, element);
}

// X_LM: the joint's frame in the body's, at q = 0. Returns it.
XMLElement* AddJoint(const Joint& joint, const JointDrive& drive,
                     const Isometry3d& X_LM, XMLElement* body) {
  XMLElement* element = body->InsertNewChildElement("joint");
  element->SetAttribute("name", joint.name.c_str());
  element->SetAttribute("type", IsRotational(joint.type) ? "hinge" : "slide");
  element->SetAttribute("pos", Text(X_LM.translation()).c_str());
  element->SetAttribute("axis", Text(X_LM.linear().col(2)).c_str());
  if (std::isfinite(joint.lower) || std::isfinite(joint.upper)) {
    SetRange("limited", "range",
             std::isfinite(joint.lower) ? joint.lower : joint.upper - kTurn,
             std::isfinite(joint.upper) ? joint.upper : joint.lower + kTurn,
             element);
  }
  SetIfAny("armature", joint.armature, element);
  SetIfAny("damping", joint.viscous, element);
  SetIfAny("frictionloss", joint.coulomb, element);
  SetIfAny("stiffness", drive.stiffness, element);
  if (drive.stiffness != 0) SetIfAny("springref", drive.rest, element);
  return element;
}

// The force on the joint is gain ctrl - offset.
XMLElement* AddMotor(const Joint& joint, const JointDrive& drive,
                     XMLElement* actuators) {
  const bool plain = joint.offset == 0 && drive.gain == 1;
  XMLElement* motor =
      actuators->InsertNewChildElement(plain ? "motor" : "general");
  motor->SetAttribute("name", joint.name.c_str());
  motor->SetAttribute("joint", joint.name.c_str());
  const double most = std::min(joint.effort, drive.torque_limit);
  if (std::isfinite(most)) {
    SetRange("ctrllimited", "ctrlrange", -most, most, motor);
  }
  if (drive.gain != 1) Set("gainprm", drive.gain, motor);
  if (joint.offset == 0) return motor;
  motor->SetAttribute("biastype", "affine");
  motor->SetAttribute("biasprm", (ExactText(-joint.offset) + " 0 0").c_str());
  return motor;
}

// For the eye, from the link's origin to what it carries.
void AddCapsule(const Vector3d& to, XMLElement* body) {
  if (to.norm() < kThin) return;
  XMLElement* geom = body->InsertNewChildElement("geom");
  geom->SetAttribute("type", "capsule");
  geom->SetAttribute("fromto", ("0 0 0 " + Text(to)).c_str());
  Set("size", kThin, geom);
  geom->SetAttribute("mass", "0");
  geom->SetAttribute("contype", "0");
  geom->SetAttribute("conaffinity", "0");
}

// The only link that sits on link i; -1 where there are none or several.
int OnlyNext(const Robot& robot, int i) {
  const int n = robot.num_joints();
  const int end = EndOfBranch(robot.parents, i, n);
  const bool one = i + 1 < end && EndOfBranch(robot.parents, i + 1, n) == end;
  return one ? i + 1 : -1;
}

// MuJoCo has no body without mass: such a link's joint moves the next one's.
bool JoinsNext(const Robot& robot, int i) {
  return robot.links[i].inertial.mass <= 0 && OnlyNext(robot, i) >= 0;
}

// Adds the body of the links first..last, of which only `last` may have mass.
XMLElement* AddBody(const RobotDescription& description, const MjcfLaws& laws,
                    int first, int last, XMLElement* parent) {
  const std::vector<Link>& links = description.robot.links;
  Isometry3d X_PL = Isometry3d::Identity();
  for (int i = first; i <= last; ++i) X_PL = X_PL * links[i].X_PL(0);
  XMLElement* body = parent->InsertNewChildElement("body");
  body->SetAttribute("name", links[last].name.c_str());
  SetPose(X_PL, body);
  if (links[last].inertial.mass > 0) AddInertial(links[last].inertial, body);
  Isometry3d X_PM = Isometry3d::Identity();
  for (int i = first; i <= last; ++i) {
    X_PM = X_PM * links[i].X_PF;
    // Of a body with one joint exactly what the link says.
    const Isometry3d X_LM =
        first == last ? links[i].X_ML.inverse() : X_PL.inverse() * X_PM;
    laws.AddToJoint(
        i, AddJoint(links[i].joint, description.DriveOf(i), X_LM, body));
    X_PM = X_PM * links[i].X_ML;
  }
  const bool is_last = last + 1 == description.robot.num_joints();
  const int next = OnlyNext(description.robot, last);
  if (is_last) AddCapsule(description.robot.X_LT.translation(), body);
  if (next >= 0) AddCapsule(links[next].X_PF.translation(), body);
  return body;
}

std::vector<std::string> MjcfLosses(const RobotDescription& description) {
  std::vector<std::string> losses = MjcfDriveLosses(description);
  const std::vector<std::string> of_laws = MjcfLaws(description).Losses();
  losses.insert(losses.end(), of_laws.begin(), of_laws.end());
  const Robot& robot = description.robot;
  for (int i = 0; i < robot.num_joints(); ++i) {
    if (robot.links[i].inertial.mass > 0 || JoinsNext(robot, i)) continue;
    losses.push_back("MuJoCo refuses link " + robot.links[i].name +
                     ", which moves without mass");
  }
  return losses;
}

// The controller's period, or what the laws need; MuJoCo's own where neither
// asks for anything.
void AddOption(const RobotDescription& description, const MjcfLaws& laws,
               XMLElement* root) {
  XMLElement* option = root->InsertNewChildElement("option");
  option->SetAttribute("gravity", Text(description.robot.gravity).c_str());
  const bool steps = laws.any() || description.torque_delay > 0;
  if (!description.controller && !steps) return;
  Set("timestep",
      description.controller ? 1 / description.controller->rate_hz
                             : laws.timestep(),
      option);
  option->SetAttribute("integrator", "implicit");
}

void AddActuators(const RobotDescription& description, const MjcfLaws& laws,
                  XMLElement* root) {
  const Robot& robot = description.robot;
  XMLElement* actuators = root->InsertNewChildElement("actuator");
  if (description.controller) AddMjcfDrives(description, actuators);
  for (int j = 0; !description.controller && j < robot.num_joints(); ++j) {
    SetMjcfDelay(
        description.torque_delay, laws.timestep(),
        AddMotor(robot.links[j].joint, description.DriveOf(j), actuators));
  }
  laws.AddActuators(actuators);
}

}  // namespace

std::string MakeMjcf(const RobotDescription& description) {
  const Robot& robot = description.robot;
  const MjcfLaws laws(description);
  tinyxml2::XMLDocument document;
  XMLElement* root = document.NewElement("mujoco");
  document.InsertEndChild(root);
  root->SetAttribute("model", robot.name.c_str());
  root->InsertNewChildElement("compiler")->SetAttribute("angle", "radian");
  AddOption(description, laws, root);
  XMLElement* const world = root->InsertNewChildElement("worldbody");
  std::vector<XMLElement*> bodies(robot.links.size());
  for (int first = 0, last = 0; last < robot.num_joints(); ++last) {
    if (JoinsNext(robot, last)) continue;
    const int before = robot.parent(first);
    bodies[last] = AddBody(description, laws, first, last,
                           before < 0 ? world : bodies[before]);
    first = last + 1;
  }
  if (!robot.tool_name.empty()) {
    XMLElement* tool = bodies.back()->InsertNewChildElement("body");
    tool->SetAttribute("name", robot.tool_name.c_str());
    SetPose(robot.X_LT, tool);
  }
  laws.AddTendons(root);
  AddActuators(description, laws, root);
  return XmlText(document);
}

RobotFormat MjcfFormat() {
  return {
      "mjcf",      "MJCF",
      "robot.xml", {RobotField::kVelocityLimit, RobotField::kTorqueLimitSlope},
      &MakeMjcf,   &MjcfLosses};
}

RobotFormat PlainMjcfFormat() {
  return {"mjcf_plain",
          "plain MJCF",
          "robot_plain.xml",
          {RobotField::kVelocityLimit, RobotField::kTorqueLimitSlope,
           RobotField::kLaws},
          &MakeMjcf,
          &MjcfLosses};
}

}  // namespace armcal

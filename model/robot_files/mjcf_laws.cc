#include "model/robot_files/mjcf_laws.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "model/dynamics/forward_dynamics.h"
#include "model/robot_files/mjcf_saturation.h"
#include "model/text/exact_text.h"
#include "model/text/format.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using tinyxml2::XMLElement;

// Whole numbers of steps are a millisecond, as controllers have whole ones.
constexpr double kMillisecond = 1e-3;
constexpr double kUsualStep = kMillisecond / 2;         // s
constexpr double kShortestLawStep = kMillisecond / 10;  // s
// Of what an explicit step takes: a friction's slope of 1 / (step * inverse
// inertia) would bring the joint to rest in one step, and twice that is
// unstable. Inertias away from the position 0 may be less.
constexpr double kMargin = .6;
// MuJoCo wants a motor constant above 0; a winding of 1 Ohm then brakes with
// its square, 1e-18 N m s/rad.
constexpr const char* kNoMotor = "1e-9 1e-9";

XMLElement* AddPassive(const Joint& joint, const std::string& name,
                       XMLElement* actuators) {
  XMLElement* element = actuators->InsertNewChildElement("dcmotor");
  element->SetAttribute("name", name.c_str());
  element->SetAttribute("joint", joint.name.c_str());
  element->SetAttribute("input", "none");
  element->SetAttribute("motorconst", kNoMotor);
  element->SetAttribute("resistance", "1");
  return element;
}

bool IsStiff(const GearSpring& gear, double inverse) {
  return std::sqrt(gear.stiffness * inverse) * kShortestLawStep > kMargin;
}

}  // namespace

MjcfLaws::MjcfLaws(const RobotDescription& description)
    : description_(description) {
  if (!any()) return;
  const Robot& robot = description.robot;
  const int n = robot.num_joints();
  MatrixXd M = MassMatrix(robot, VectorXd::Zero(n));
  for (int j = 0; j < n; ++j) {
    if (description.DriveOf(j).gear) continue;
    M(j, j) += robot.links[j].joint.armature;
  }
  motor_.resize(n);
  gear_.resize(n);
  for (int j = 0; j < n; ++j) {
    motor_[j] = gear_[j] = SolveInertia(M, VectorXd::Unit(n, j))[j];
    if (!description.DriveOf(j).gear) continue;
    motor_[j] = 1 / robot.links[j].joint.armature;
    gear_[j] += motor_[j];
  }
}

bool MjcfLaws::any() const {
  return std::any_of(description_.drives.begin(), description_.drives.end(),
                     [](const JointDrive& drive) { return drive.HasLaws(); });
}

double MjcfLaws::StepOf(int j) const {
  const JointDrive drive = description_.DriveOf(j);
  double step = kUsualStep;
  const double slope = SteepestSlope(drive.dry) * motor_[j];
  if (slope > 0) step = std::min(step, kMargin / slope);
  if (drive.gear) {
    const double rate = std::sqrt(drive.gear->stiffness * gear_[j]);
    step = std::min(step, kMargin / rate);
  }
  return std::max(step, kShortestLawStep);
}

double MjcfLaws::timestep() const {
  double step = kUsualStep;
  for (int j = 0; j < motor_.size(); ++j) step = std::min(step, StepOf(j));
  return kMillisecond / std::ceil(kMillisecond / step - 1e-9);
}

// A spring that is too stiff for the shortest step is as stiff as that takes,
// and so are the dampers of flanks, which soft limits step explicitly.
void MjcfLaws::AddGear(int j, XMLElement* motor) const {
  const GearSpring gear = *description_.DriveOf(j).gear;
  XMLElement* element = motor->GetDocument()->NewElement("joint");
  motor->Parent()->InsertEndChild(element);
  const std::string name = description_.robot.links[j].joint.name + "_gear";
  element->SetAttribute("name", name.c_str());
  for (const char* same : {"type", "pos", "axis"}) {
    element->SetAttribute(same, motor->Attribute(same));
  }
  const double rate = kMargin / timestep();
  const double stiffness = std::min(gear.stiffness, rate * rate / gear_[j]);
  if (gear.gap == 0) {
    element->SetAttribute(
        "stiffness",
        gear.stiffening == 0
            ? ExactText(stiffness).c_str()
            : ExactTexts({stiffness, 0, stiffness * gear.stiffening}).c_str());
    element->SetAttribute("damping", ExactText(gear.damping).c_str());
    return;
  }
  element->SetAttribute("limited", "true");
  element->SetAttribute("range",
                        ExactTexts({-gear.gap / 2, gear.gap / 2}).c_str());
  const double damping = std::min(gear.damping, rate / gear_[j]);
  SetMjcfSoftness("limit", stiffness, damping, gear_[j], element);
}

void MjcfLaws::AddToJoint(int j, XMLElement* joint) const {
  if (!any()) return;  // inertias were not solved for then
  const JointDrive drive = description_.DriveOf(j);
  SetMjcfFriction(drive.dry, motor_[j], joint);
  if (drive.quadratic != 0) {
    const double viscous = description_.robot.links[j].joint.viscous;
    joint->SetAttribute("damping",
                        ExactTexts({viscous, drive.quadratic}).c_str());
  }
  if (drive.gear) AddGear(j, joint);
}

void MjcfLaws::AddActuators(XMLElement* actuators) const {
  for (int j = 0; j < motor_.size(); ++j) {
    const Joint& joint = description_.robot.links[j].joint;
    const JointDrive drive = description_.DriveOf(j);
    AddMjcfPushes(joint, drive.dry, actuators);
    for (size_t k = 0; k < drive.bristles.size(); ++k) {
      const BristleFriction& law = drive.bristles[k];
      AddPassive(joint, MjcfPartName(joint, "bristles", k), actuators)
          ->SetAttribute("lugre",
                         ExactTexts({law.stiffness, 0, law.coulomb, law.at_rest,
                                     law.stribeck_velocity})
                             .c_str());
    }
    for (size_t k = 0; k < drive.waves.size(); ++k) {
      const TorqueWave& law = drive.waves[k];
      AddPassive(joint, MjcfPartName(joint, "ripple", k), actuators)
          ->SetAttribute(
              "cogging",
              ExactTexts({law.amplitude, law.harmonic, law.phase}).c_str());
    }
  }
}

void MjcfLaws::AddTendons(XMLElement* root) const {
  XMLElement* tendons = root->GetDocument()->NewElement("tendon");
  for (int j = 0; j < motor_.size(); ++j) {
    const Joint& joint = description_.robot.links[j].joint;
    const JointDrive drive = description_.DriveOf(j);
    AddMjcfFrictionTendons(joint, drive.dry, motor_[j], tendons);
    AddMjcfSpringTendons(joint, drive.bounded_springs, tendons);
  }
  if (!tendons->NoChildren()) root->InsertEndChild(tendons);
}

std::vector<std::string> MjcfLaws::Losses() const {
  std::vector<std::string> losses;
  for (int j = 0; j < motor_.size(); ++j) {
    const JointDrive drive = description_.DriveOf(j);
    if (!drive.gear || !IsStiff(*drive.gear, gear_[j])) continue;
    losses.push_back(
        Format("the spring of joint %s is softer than %.4g, as "
               "steps of %.4g s are to be stable",
               description_.robot.links[j].joint.name.c_str(),
               drive.gear->stiffness, kShortestLawStep));
  }
  const std::string version = Version();
  if (!version.empty()) {
    losses.push_back("the file needs MuJoCo " + version +
                     " or later; the format mjcf_plain, with less in it, does "
                     "not");
  }
  return losses;
}

// The first version that reads the file; empty where it is 2.2.2.
std::string MjcfLaws::Version() const {
  const auto any = [this](const std::function<bool(const JointDrive&)>& has) {
    const auto& drives = description_.drives;
    return std::any_of(drives.begin(), drives.end(), has);
  };
  if (any([](const JointDrive& drive) {
        return !drive.bristles.empty() || !drive.waves.empty() ||
               drive.quadratic != 0 ||
               (drive.gear && drive.gear->stiffening != 0);
      })) {
    return "3.12";
  }
  if (description_.torque_delay > 0) return "3.8";
  return any([](const JointDrive& drive) {
    return !drive.bounded_springs.empty();
  })
             ? "2.3.1"
             : "";
}

}  // namespace armcal

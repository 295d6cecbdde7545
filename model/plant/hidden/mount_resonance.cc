#include "model/plant/hidden/mount_resonance.h"

#include <cmath>

namespace armcal {

namespace {

using Draw = EffectParameter::Draw;
using Scope = HiddenEffect::Scope;
using Eigen::Vector3d;

// The arm's moment of inertia about a level axis through the base, stretched
// out: a rod as long as all offsets to the tool together, m L^2 / 3.
double ArmInertia(const EffectSite& site) {
  double length = .1 + site.robot->robot.X_LT.translation().norm();
  for (int j = site.robot->num_passive; j < site.robot->robot.num_joints();
       ++j) {
    length += site.robot->robot.links[j].X_PL(0).translation().norm();
  }
  return site.moving_mass() * length * length / 3;
}

Vector3d Upright(const Vector3d& gravity) {
  if (gravity.isZero()) return Vector3d::UnitZ();
  return -gravity.normalized();
}
// The world's x axis made level, or where it is upright the y axis.
Vector3d LevelAxis(const Vector3d& up) {
  const Vector3d x = Vector3d::UnitX() - up.x() * up;
  return x.norm() > .1 ? x.normalized()
                       : Vector3d::UnitZ().cross(up).normalized();
}

// A base plate that turns about the axis `z` in W on a spring and damper.
Link BasePlate(const std::string& name, const Vector3d& z, double inertia) {
  Link link;
  link.name = name;
  link.joint.name = name + "_sway";
  link.X_PF.linear() = Eigen::Quaterniond::FromTwoVectors(Vector3d::UnitZ(), z)
                           .toRotationMatrix();
  link.X_ML.linear() = link.X_PF.linear().transpose();
  link.inertial = InertialParameters::FromCenterOfMass(
      inertia, Vector3d::Zero(), inertia * Eigen::Matrix3d::Identity());
  link.has_inertial = true;
  return link;
}

// All that sits on the base sits on the link, and all that names a joint by its
// number moves up by one.
void InsertUnderBase(const Link& link, SimulatedRobot* robot) {
  robot->robot.links.insert(robot->robot.links.begin(), link);
  if (robot->robot.branches()) {
    for (int& parent : robot->robot.parents) ++parent;
    robot->robot.parents.insert(robot->robot.parents.begin(), -1);
  }
  ++robot->num_passive;
  for (JointLaw& law : robot->joint_laws) ++law.joint;
  for (Transmission& law : robot->transmissions) ++law.joint;
  for (WrenchLaw& law : robot->wrenches) ++law.attachment.link;
  if (!robot->thermal.empty()) {
    robot->thermal.insert(robot->thermal.begin(), JointThermal());
  }
}

// A joint under the base with tau = -k q - c q'.
void Sway(const std::string& name, const Vector3d& axis, double inertia,
          double k, double c, SimulatedRobot* robot) {
  InsertUnderBase(BasePlate(name, axis, inertia), robot);
  const int above = robot->robot.num_joints();
  robot->joint_laws.push_back(
      {0, {}, false, [=](const ArmInstant& at, const double*, double*) {
         return -k * FromTip(at.position, above) -
                c * FromTip(at.velocity, above);
       }});
}

// Two level axes through the base, x below y, a plate on each as heavy to turn
// as the arm: a stand much lighter would let the joints' loops shake it.
HiddenEffect Mount() {
  return {"mount_resonance",
          false,
          Scope::kRobot,
          "A stand that sways: the whole arm rocks on its mount, which no "
          "encoder sees.",
          {{"frequency", "Hz", 8, 4, 15, Draw::kLog, 2, 60},
           {"damping_ratio", "1", .03, .02, .1, Draw::kLog, .002, 1}},
          [](const EffectSite& site) -> std::vector<EffectValue> {
            const double I = ArmInertia(site), omega = 2 * M_PI * site.p[0];
            const double ratio = site.p[1];
            const Vector3d up = Upright(site.robot->robot.gravity);
            const Vector3d x = LevelAxis(up);
            // What turns about y: the arm and a plate; about x: one plate more.
            Sway("mount_y", up.cross(x), I, 2 * I * omega * omega,
                 4 * ratio * I * omega, site.robot);
            Sway("mount_x", x, I, 3 * I * omega * omega, 6 * ratio * I * omega,
                 site.robot);
            return {{"frequency", "Hz", site.p[0]},
                    {"stiffness", "N m/rad", 2 * I * omega * omega}};
          },
          [](const SimulatedRobot& robot, int) -> std::string {
            return robot.num_passive == 0 ? "" : "the base sways already";
          }};
}

}  // namespace

std::vector<HiddenEffect> MountResonance() { return {Mount()}; }

}  // namespace armcal

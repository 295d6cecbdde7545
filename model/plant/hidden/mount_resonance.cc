#include "model/plant/hidden/mount_resonance.h"

#include <cmath>

namespace armcal {

namespace {

constexpr double kTwoPi = 6.283185307179586;

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

// All that names a joint by its number moves up by one.
void InsertUnderBase(const Link& link, SimulatedRobot* robot) {
  robot->robot.links.insert(robot->robot.links.begin(), link);
  ++robot->num_passive;
  for (JointLaw& law : robot->joint_laws) ++law.joint;
  for (Transmission& law : robot->transmissions) ++law.joint;
  for (WrenchLaw& law : robot->wrenches) ++law.attachment.link;
  if (!robot->thermal.empty()) {
    robot->thermal.insert(robot->thermal.begin(), JointThermal());
  }
}

// Two level axes through the base, x below y, each with tau = -k q - c q'. The
// plate has a tenth of the arm's inertia.
HiddenEffect Mount() {
  return {
      "mount_resonance",
      false,
      Scope::kRobot,
      "A stand that sways: the whole arm rocks on its mount, which no "
      "encoder sees.",
      {{"frequency", "Hz", 8, 4, 15, Draw::kLog},
       {"damping_ratio", "1", .03, .02, .1, Draw::kLog}},
      [](const EffectSite& site) -> std::vector<EffectValue> {
        const double I = ArmInertia(site), plate = .1 * I;
        const double omega = kTwoPi * site.p[0];
        const double k = (I + plate) * omega * omega;
        const double c = 2 * site.p[1] * (I + plate) * omega;
        const Vector3d up = Upright(site.robot->robot.gravity);
        const Vector3d x = LevelAxis(up);
        const Vector3d y = up.cross(x);
        InsertUnderBase(BasePlate("mount_y", y, plate / 2), site.robot);
        InsertUnderBase(BasePlate("mount_x", x, plate / 2), site.robot);
        for (const int joint : {0, 1}) {
          const int above = site.robot->robot.num_joints() - joint;
          site.robot->joint_laws.push_back(
              {joint,
               {},
               false,
               [=](const ArmInstant& at, const double*, double*) {
                 return -k * FromTip(at.position, above) -
                        c * FromTip(at.velocity, above);
               }});
        }
        return {{"stiffness", "N m/rad", k}, {"frequency", "Hz", site.p[0]}};
      },
      [](const SimulatedRobot& robot, int) -> std::string {
        return robot.num_passive == 0 ? "" : "the base sways already";
      }};
}

}  // namespace

std::vector<HiddenEffect> MountResonance() { return {Mount()}; }

}  // namespace armcal

#include "model/plant/hidden/rigid_body_effects.h"

#include <cmath>

namespace armcal {

namespace {

using Draw = EffectParameter::Draw;
using Scope = HiddenEffect::Scope;
using Eigen::Vector3d;

HiddenEffect Armature() {
  return {
      "armature",
      true,
      Scope::kJoint,
      "A motor with more inertia than assumed: torque for accelerations.",
      {{"inertia", "1", .2, .03, 1, Draw::kLog, 3e-3, 5}},
      [](const EffectSite& site) -> std::vector<EffectValue> {
        const double I = site.p[0] * site.context->inertia[site.joint];
        site.link().joint.armature += I;
        return {{"armature", IsRotational(site.type()) ? "kg m^2" : "kg", I}};
      },
      nullptr};
}

// From the joint's axis to the next joint's, in the joint's moved frame M;
// across the axis of a revolute joint, which cannot feel more.
Vector3d LengthDirection(const Link& link, const Link& next) {
  Vector3d p = (link.X_ML * next.X_PF).translation();
  if (IsRotational(link.joint.type)) p.z() = 0;
  return p.norm() > 1e-3 ? p.normalized().eval() : Vector3d::UnitX();
}

HiddenEffect LinkLength() {
  return {"link_length",
          true,
          Scope::kJoint,
          "A link longer than in the robot file: all that it carries sits "
          "further out.",
          {{"length", "m", .02, .005, .05, Draw::kLogEitherSign, 5e-4, .3}},
          [](const EffectSite& site) -> std::vector<EffectValue> {
            Robot& robot = site.robot->robot;
            const Link& next = robot.links[robot.next(site.index())];
            const Vector3d p_L =
                site.p[0] * (site.link().X_ML.linear().transpose() *
                             LengthDirection(site.link(), next));
            for (int k = site.index() + 1; k < robot.num_joints(); ++k) {
              if (robot.parent(k) != site.index()) continue;
              robot.links[k].X_PF.pretranslate(p_L);
            }
            return {{"length", "m", site.p[0]}};
          },
          [](const SimulatedRobot& robot, int joint) -> std::string {
            return robot.robot.next(robot.num_passive + joint) >= 0
                       ? ""
                       : "the link carries no joint";
          }};
}

// Turns gravity about an axis across it: exact, however large.
HiddenEffect BaseTilt() {
  return {"base_tilt",
          true,
          Scope::kRobot,
          "A base that is not level: gravity pulls from another direction.",
          {{"tilt", "rad", .02, .003, .1, Draw::kLog, 3e-4, 1.5},
           {"direction", "rad", 1, 0, 2 * M_PI, Draw::kUniform}},
          [](const EffectSite& site) -> std::vector<EffectValue> {
            Vector3d& g = site.robot->robot.gravity;
            const Vector3d x = g.unitOrthogonal();
            const Vector3d axis =
                Eigen::AngleAxisd(site.p[1], g.normalized()) * x;
            g = Eigen::AngleAxisd(site.p[0], axis) * g;
            return {{"tilt", "rad", site.p[0]},
                    {"gravity_x", "m/s^2", g.x()},
                    {"gravity_y", "m/s^2", g.y()},
                    {"gravity_z", "m/s^2", g.z()}};
          },
          [](const SimulatedRobot& robot, int) -> std::string {
            return robot.robot.gravity.isZero() ? "there is no gravity" : "";
          }};
}

// A solid steel ball about its own centre, at a place near the tool.
HiddenEffect Payload() {
  return {"payload",
          true,
          Scope::kRobot,
          "Something in the gripper: mass at the tool.",
          {{"mass", "1", .03, .005, .1, Draw::kLog, 5e-4, .6},
           {"x", "m", .03, -.1, .1, Draw::kUniform, -.6, .6},
           {"y", "m", -.02, -.1, .1, Draw::kUniform, -.6, .6},
           {"z", "m", .05, 0, .15, Draw::kUniform, -.6, .6}},
          [](const EffectSite& site) -> std::vector<EffectValue> {
            Robot& robot = site.robot->robot;
            const double mass = site.p[0] * site.moving_mass();
            const Vector3d com = robot.X_LT * site.p.tail<3>().eval();
            const double radius = std::cbrt(mass / (4 * M_PI / 3 * 7850));
            const double inertia = .4 * mass * radius * radius;
            robot.links.back().inertial += InertialParameters::FromCenterOfMass(
                mass, com, inertia * Eigen::Matrix3d::Identity());
            return {{"mass", "kg", mass},
                    {"com_x", "m", com.x()},
                    {"com_y", "m", com.y()},
                    {"com_z", "m", com.z()},
                    {"inertia", "kg m^2", inertia}};
          },
          nullptr};
}

// A cube of aluminium about its own centre, at a place on the link.
HiddenEffect AddedMass() {
  return {"added_mass",
          true,
          Scope::kJoint,
          "Something fixed to a link: a valve block, hoses, a weight.",
          {{"mass", "1", .03, .005, .1, Draw::kLog, 5e-4, .6},
           {"x", "m", .1, -.2, .2, Draw::kUniform, -.8, .8},
           {"y", "m", -.05, -.2, .2, Draw::kUniform, -.8, .8},
           {"z", "m", .08, -.2, .2, Draw::kUniform, -.8, .8}},
          [](const EffectSite& site) -> std::vector<EffectValue> {
            const double mass = site.p[0] * site.moving_mass();
            const Vector3d com = site.p.tail<3>();
            const double edge = std::cbrt(mass / 2700);
            site.link().inertial += InertialParameters::FromCenterOfMass(
                mass, com,
                mass * edge * edge / 6 * Eigen::Matrix3d::Identity());
            return {{"mass", "kg", mass},
                    {"hx", "kg m", mass * com.x()},
                    {"hy", "kg m", mass * com.y()},
                    {"hz", "kg m", mass * com.z()}};
          },
          [](const SimulatedRobot& robot, int joint) -> std::string {
            return robot.num_passive + joint + 1 < robot.robot.num_joints()
                       ? ""
                       : "on the last link it is a payload";
          }};
}

HiddenEffect LinkInertia() {
  return {
      "link_inertia",
      true,
      Scope::kJoint,
      "A link heavier or lighter than in the robot file by one share of "
      "its mass, first moment and inertia.",
      {{"share", "1", .1, .03, .3, Draw::kLogEitherSign, 3e-3, .9}},
      [](const EffectSite& site) -> std::vector<EffectValue> {
        InertialParameters& link = site.link().inertial;
        const double mass = link.mass;
        link =
            InertialParameters::FromVector((1 + site.p[0]) * link.ToVector());
        return {{"share", "1", site.p[0]}, {"mass", "kg", site.p[0] * mass}};
      },
      nullptr};
}

}  // namespace

std::vector<HiddenEffect> RigidBodyEffects() {
  std::vector<HiddenEffect> effects = {Armature(), LinkLength(), BaseTilt(),
                                       Payload(),  AddedMass(),  LinkInertia()};
  for (HiddenEffect& effect : effects) effect.changes_robot = true;
  return effects;
}

}  // namespace armcal

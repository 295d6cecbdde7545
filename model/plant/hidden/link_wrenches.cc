#include "model/plant/hidden/link_wrenches.h"

#include <algorithm>
#include <cmath>

#include "model/plant/hidden/joint_axes.h"
#include "model/plant/hidden/random_signal.h"

namespace armcal {

namespace {

using Draw = EffectParameter::Draw;
using Scope = HiddenEffect::Scope;
using Eigen::Vector3d;
using Eigen::VectorXd;

Attachment Tool(const SimulatedRobot& robot) {
  return {robot.robot.num_joints() - 1, robot.robot.X_LT.translation()};
}

// Evenly over the sphere.
Vector3d DrawDirection(std::mt19937_64* random) {
  const double z = DrawUniform(-1, 1, random);
  const double angle = DrawUniform(0, 2 * M_PI, random);
  const double r = std::sqrt(1 - z * z);
  return {r * std::cos(angle), r * std::sin(angle), z};
}

// F sech^2((t - t0) / b) at the tool in one direction of the world.
HiddenEffect ExternalContact() {
  return {"external_contact",
          true,
          Scope::kRobot,
          "A person who leans on the tool once: a force that swells and fades "
          "in time.",
          {{"force", "1", .05, .01, .2, Draw::kLog, 1e-3, 1},
           {"time", "1", .5, .15, .85, Draw::kUniform, 0, 1},
           {"width", "s", .4, .1, 1, Draw::kLog, .03, 10}},
          [](const EffectSite& site) -> std::vector<EffectValue> {
            const double F = site.p[0] * 9.81 * site.moving_mass();
            const double t0 = site.p[1] * site.context->duration;
            const double width = site.p[2];
            std::mt19937_64 random = site.RandomInTime("external_contact");
            const Vector3d force = F * DrawDirection(&random);
            site.robot->wrenches.push_back(
                {Tool(*site.robot), nullptr, 0,
                 [=](const PointInstant& at, const double*, double*) -> Wrench {
                   const double c = std::cosh((at.t - t0) / width);
                   return {Vector3d::Zero(), force / (c * c)};
                 }});
            return {{"force", "N", F},           {"time", "s", t0},
                    {"width", "s", width},       {"force_x", "N", force.x()},
                    {"force_y", "N", force.y()}, {"force_z", "N", force.z()}};
          },
          nullptr};
}

// A mass on a spring at the tool, both isotropic:
// m x'' = m g - k (x - p) - c (x' - v); the tool feels the spring and damper.
WrenchLaw SprungMass(const SimulatedRobot& robot, double m, double k,
                     double c) {
  const Vector3d g = robot.robot.gravity;
  WrenchLaw law;
  law.attachment = Tool(robot);
  law.num_states = 6;  // x, x' in W; hangs at first
  law.initial_state = [=](const Eigen::Isometry3d& X_WP) -> VectorXd {
    VectorXd state(6);
    state << X_WP.translation() + m * g / k, Vector3d::Zero();
    return state;
  };
  law.wrench = [=](const PointInstant& at, const double* state,
                   double* rate) -> Wrench {
    const Eigen::Map<const Vector3d> x(state), v(state + 3);
    const Vector3d force = k * (x - at.X_WP.translation()) + c * (v - at.v_WP);
    const Vector3d acceleration = g - force / m;
    std::copy_n(v.data(), 3, rate);
    std::copy_n(acceleration.data(), 3, rate + 3);
    return {Vector3d::Zero(), force};
  };
  return law;
}

HiddenEffect Slosh() {
  return {"slosh",
          false,
          Scope::kRobot,
          "A load that sloshes: a mass on a spring at the tool, which keeps "
          "swinging after the arm has stopped.",
          {{"mass", "1", .03, .01, .1, Draw::kLog, 1e-3, .5},
           {"frequency", "Hz", 3, 1, 8, Draw::kLog, .3, 30},
           {"damping_ratio", "1", .05, .02, .1, Draw::kLog, .002, 1}},
          [](const EffectSite& site) -> std::vector<EffectValue> {
            const double m = site.p[0] * site.moving_mass();
            const double omega = 2 * M_PI * site.p[1];
            const double k = m * omega * omega;
            site.robot->wrenches.push_back(
                SprungMass(*site.robot, m, k, 2 * site.p[2] * m * omega));
            return {{"mass", "kg", m},
                    {"frequency", "Hz", site.p[1]},
                    {"stiffness", "N/m", k}};
          },
          nullptr};
}

// A flywheel of angular momentum H fixed in the link: moment -w x H on it,
// across the link's angular velocity w.
HiddenEffect Gyroscope() {
  return {"gyroscope",
          false,
          Scope::kJoint,
          "A spindle that runs in a link: turning it pushes the joints "
          "sideways, with no power.",
          {{"momentum", "1", .1, .02, .3, Draw::kLog, 2e-3, 1.5}},
          [](const EffectSite& site) -> std::vector<EffectValue> {
            std::mt19937_64 random = site.Random("gyroscope");
            const double H = site.p[0] * site.torque() / site.speed();
            const Vector3d H_L = H * DrawDirection(&random);
            site.robot->wrenches.push_back(
                {{site.index(), Vector3d::Zero()},
                 nullptr,
                 0,
                 [=](const PointInstant& at, const double*, double*) -> Wrench {
                   return {(at.X_WP.linear() * H_L).cross(at.w_WP),
                           Vector3d::Zero()};
                 }});
            return {{"momentum_x", "N m s", H_L.x()},
                    {"momentum_y", "N m s", H_L.y()},
                    {"momentum_z", "N m s", H_L.z()}};
          },
          WhyTurnsAboutOneAxis};
}

// A weight on a loose bolt slides along the axis u of its link to the side that
// gravity pulls it to: by s = c / sqrt(c^2 + 0.1^2), c = u . g / |g|, of its
// way. Its moment is s u x (weight times way).
HiddenEffect LooseBolt() {
  return {"loose_bolt",
          false,
          Scope::kJoint,
          "A weight on a loose bolt: a link's centre of mass jumps to the "
          "other side when the link turns over.",
          {{"moment", "1", .05, .01, .2, Draw::kLog, 1e-3, 1}},
          [](const EffectSite& site) -> std::vector<EffectValue> {
            std::mt19937_64 random = site.Random("loose_bolt");
            const Vector3d u_L = DrawDirection(&random);
            const double moment = site.p[0] * site.torque();
            const Vector3d down = site.robot->robot.gravity.normalized();
            site.robot->wrenches.push_back(
                {{site.index(), Vector3d::Zero()},
                 nullptr,
                 0,
                 [=](const PointInstant& at, const double*, double*) -> Wrench {
                   const Vector3d u = at.X_WP.linear() * u_L;
                   const double c = u.dot(down);
                   return {moment * c / std::hypot(c, .1) * u.cross(down),
                           Vector3d::Zero()};
                 }});
            return {{"moment", "N m", moment},
                    {"axis_x", "1", u_L.x()},
                    {"axis_y", "1", u_L.y()},
                    {"axis_z", "1", u_L.z()}};
          },
          WhyGravityIsAlongItsAxes};
}

}  // namespace

std::vector<HiddenEffect> LinkWrenches() {
  return {ExternalContact(), Slosh(), Gyroscope(), LooseBolt()};
}

}  // namespace armcal

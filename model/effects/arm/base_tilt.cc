#include <cmath>

#include "model/effects/effect_parts.h"

namespace armcal {
inline namespace effects {

namespace {

// Two directions across gravity; x and y where it points down.
void Tangents(const Eigen::Vector3d& gravity, Eigen::Vector3d* x,
              Eigen::Vector3d* y) {
  const Eigen::Vector3d up = -gravity.normalized();
  const Eigen::Vector3d ahead = std::abs(up.x()) < .9
                                    ? Eigen::Vector3d::UnitX()
                                    : Eigen::Vector3d::UnitY();
  *x = (ahead - ahead.dot(up) * up).normalized();
  *y = up.cross(*x);
}

// Gravity with what the tilt adds across it: longer than it was by the square
// of the tilt, so that torques are linear in p.
Eigen::Vector3d TiltedGravity(const Eigen::Vector3d& gravity,
                              const Eigen::VectorXd& p) {
  Eigen::Vector3d x, y;
  Tangents(gravity, &x, &y);
  return gravity + p[0] * x + p[1] * y;
}

std::vector<EffectEstimate> TiltEstimates(const EffectSite& site,
                                          const Eigen::VectorXd& p) {
  const Eigen::Vector3d& g = site.robot->gravity;
  const Eigen::Vector3d tilted = TiltedGravity(g, p).normalized() * g.norm();
  // Where the axis that gravity turned about lies, from a vector across it.
  const Eigen::Vector3d axis = g.cross(tilted), from = g.unitOrthogonal();
  const double direction =
      std::atan2(axis.dot(g.normalized().cross(from)), axis.dot(from));
  return {{"tilt", "rad", std::atan(p.norm() / g.norm())},
          {"direction", "rad", direction},
          {"gravity_x", "m/s^2", tilted.x()},
          {"gravity_y", "m/s^2", tilted.y()},
          {"gravity_z", "m/s^2", tilted.z()}};
}

}  // namespace

// gravity + gravity_x x + gravity_y y, x and y across it: a base that is not
// level.
Effect BaseTilt() {
  Effect effect;
  effect.name = "base_tilt";
  effect.scope = Effect::Scope::kRobot;
  effect.nature = Effect::Nature::kDay;
  effect.law = "tau = ID(gravity turned) - ID(gravity)";
  effect.shows = "gravity in many poses, the first joint's included";
  const auto size = [](const EffectSite& site) {
    return .02 * site.robot->gravity.norm();
  };
  effect.parameters = {Linear("gravity_x", "m/s^2", size),
                       Linear("gravity_y", "m/s^2", size)};
  effect.apply = [](const EffectSite&, const Eigen::VectorXd& p,
                    SimulatedRobot* robot) {
    Eigen::Vector3d& gravity = robot->robot.gravity;
    gravity = TiltedGravity(gravity, p);
  };
  effect.estimates = TiltEstimates;
  effect.unfit = [](const EffectSite& site) -> std::string {
    return site.robot->gravity.isZero() ? "there is no gravity" : "";
  };
  effect.experiment = "the arm stretched out, all around the first joint";
  return effect;
}

}  // namespace effects
}  // namespace armcal

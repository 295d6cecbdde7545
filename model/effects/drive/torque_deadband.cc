#include <algorithm>
#include <cmath>

#include "model/effects/effect_parts.h"

namespace armcal {
inline namespace effects {

namespace {

// x >= 0 with x + d tanh(x / s) = y >= 0. Newton's steps rise to it from
// below, because the left side is concave.
double Given(double y, double d, double s) {
  constexpr int kMostSteps = 20;
  double x = std::max(0., y - d);
  for (int i = 0; i < kMostSteps; ++i) {
    const double t = std::tanh(x / s);
    const double step = (y - x - d * t) / (1 + d / s * (1 - t * t));
    x += step;
    if (std::abs(step) <= 1e-12 * (x + s)) break;
  }
  return x;
}

}  // namespace

// logged = given + deadband tanh(given / softness): the motor gives less than
// asked by a constant, and near zero nothing.
Effect TorqueDeadband() {
  Effect effect;
  effect.name = "torque_deadband";
  effect.nature = Effect::Nature::kLaw;
  effect.law = "tau = deadband tanh(tau_given/softness)";
  effect.shows = "torques that change sign";
  effect.parameters = {Linear("deadband", "E", ShareOfTorque(.03),
                              EffectParameter::Sign::kPositive),
                       Gridded("softness", "E", [](const EffectSite& site) {
                         return GeometricGrid(.02 * TorqueScale(site),
                                              .2 * TorqueScale(site), 3);
                       })};
  effect.unfit = WhyNotRecorded;
  effect.of_the_drive = true;
  effect.apply = [](const EffectSite& site, const Eigen::VectorXd& p,
                    SimulatedRobot* robot) {
    const double d = p[0], s = p[1];
    if (d <= 0) return;
    AddActuator(
        site,
        [=](double commanded) {
          return std::copysign(Given(std::abs(commanded), d, s), commanded);
        },
        [=](double given) { return given + d * std::tanh(given / s); }, robot);
  };
  effect.near_zero = true;
  effect.means = {"coulomb_friction"};
  effect.stand_ins = {JointTerm::kViscous, JointTerm::kCoulomb};
  effect.numbers = [](const EffectSite&, const Eigen::VectorXd& p) {
    return EffectNumbers{{"deadband", p[0]}, {"softness", p[1]}};
  };
  effect.experiment = "slow motion through poses in which the load vanishes";
  return effect;
}

}  // namespace effects
}  // namespace armcal

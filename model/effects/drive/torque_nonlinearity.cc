#include <cmath>

#include "model/effects/effect_parts.h"

namespace armcal {
inline namespace effects {
namespace {

// Twice what the joint usually gives: where `fall` is meant.
double FallTorque(const EffectSite& site) { return 2 * TorqueScale(site); }

}  // namespace

// logged = given (1 + fall (given / fall_torque)^2), the first odd term by
// which iron that saturates takes more current than torque: of a constant that
// falls with the current's square.
Effect TorqueNonlinearity() {
  Effect effect;
  effect.name = "torque_nonlinearity";
  effect.nature = Effect::Nature::kLaw;
  effect.law = "tau = fall tau_given^3/fall_torque^2";
  effect.shows = "large torques, in motion or at rest";
  effect.parameters = {Linear(
      "fall", "1", [](const EffectSite&) { return .05; },
      EffectParameter::Sign::kPositive)};
  effect.unfit = WhyNotRecorded;
  effect.of_the_drive = true;
  effect.apply = [](const EffectSite& site, const Eigen::VectorXd& p,
                    SimulatedRobot* robot) {
    const double fall = p[0], peak = FallTorque(site);
    if (fall <= 0) return;
    // x + fall x^3 = y has one real root.
    const double a = std::sqrt(3 * fall);
    AddActuator(
        site,
        [=](double commanded) {
          const double y = commanded / peak;
          return peak * 2 / a * std::sinh(std::asinh(1.5 * a * y) / 3);
        },
        [=](double given) {
          const double x = given / peak;
          return given * (1 + fall * x * x);
        },
        robot);
  };
  effect.estimates = [](const EffectSite& site, const Eigen::VectorXd& p) {
    return std::vector<EffectEstimate>{
        {"fall", "1", p[0]},
        {"fall_torque", UnitAt(site, "E"), FallTorque(site)}};
  };
  effect.numbers = [](const EffectSite& site, const Eigen::VectorXd& p) {
    return EffectNumbers{{"fall", p[0]}, {"fall_torque", FallTorque(site)}};
  };
  effect.experiment = "loads from small to the joint's limit";
  return effect;
}

}  // namespace effects
}  // namespace armcal

#include "model/effects/effect_parts.h"

namespace armcal {
inline namespace effects {

// stamp = (1 + rate) t + unevenness e: a clock that runs fast, and as unevenly
// as stamps are beside even samples (e of each stamp, TimeBase::stamp_errors).
Effect TimeBase() {
  Effect effect;
  effect.name = "time_base";
  effect.scope = Effect::Scope::kRobot;
  effect.nature = Effect::Nature::kRecording;
  effect.is_clock = true;
  effect.law = "tau = ID((1 + rate) qd, (1 + rate)^2 qdd) - ID(qd, qdd)";
  effect.shows = "fast motion, against a robot whose masses are known";
  effect.parameters = {
      Linear("rate", "1", [](const EffectSite&) { return .005; }),
      Linear("unevenness", "1", [](const EffectSite&) { return .5; })};
  effect.apply = [](const EffectSite&, const Eigen::VectorXd& p,
                    SimulatedRobot* robot) {
    const double rate = p[0];
    // What is left of 1 * t by rounding, a regression would scale up.
    if (rate != 0) robot->clock = [=](double t) { return (1 + rate) * t; };
    robot->clock_unevenness = p[1];
  };
  // A clock's rate changes all inertias by its square and all viscous friction
  // by itself. Many joints do not change so together; one may.
  effect.unfit = [](const EffectSite& site) -> std::string {
    return site.robot->num_joints() > 1
               ? ""
               : "one joint's inertia and friction look the same";
  };
  effect.experiment = "the log beside that of another clock";
  return effect;
}

}  // namespace effects
}  // namespace armcal

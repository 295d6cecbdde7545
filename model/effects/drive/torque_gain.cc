#include "model/effects/effect_parts.h"

namespace armcal {
inline namespace effects {

// logged = (1 + gain) given: a motor constant other than assumed.
Effect TorqueGain() {
  Effect effect;
  effect.name = "torque_gain";
  effect.nature = Effect::Nature::kRecording;
  effect.law = "tau = gain tau_given";
  effect.shows = "any motion, against a robot whose masses are known";
  effect.parameters = {
      Linear("gain", "1", [](const EffectSite&) { return .05; })};
  effect.apply = [](const EffectSite& site, const Eigen::VectorXd& p,
                    SimulatedRobot* robot) { AddGain(site, p[0], robot); };
  effect.set_drive = [](const EffectNumbers& numbers, JointDrive* drive) {
    drive->gain /= 1 + NumberOf(numbers, "gain");
    return true;
  };
  effect.numbers = [](const EffectSite&, const Eigen::VectorXd& p) {
    return EffectNumbers{{"gain", p[0]}};
  };
  effect.unfit = WhyNotRecorded;
  effect.of_the_drive = true;
  effect.estimates_a_factor = true;
  effect.plausible = IsOfAMotorConstant;
  effect.experiment = "a known payload, held and moved";
  return effect;
}

}  // namespace effects
}  // namespace armcal

#include "model/effects/effect_parts.h"

namespace armcal {
inline namespace effects {

namespace {

// A motor that gives ten times what is recorded or more, or the opposite, or a
// third of it, has another fault than its constant.
bool IsOfAConstant(const EffectSite&,
                   const std::vector<EffectEstimate>& estimates) {
  return estimates[0].value > -.9 && estimates[0].value < 2;
}

}  // namespace

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
                    SimulatedRobot* robot) {
    const double gain = p[0];
    AddActuator(
        site, [=](double commanded) { return commanded / (1 + gain); },
        [=](double given) { return (1 + gain) * given; }, robot);
  };
  effect.set_drive = [](const EffectNumbers& numbers, JointDrive* drive) {
    drive->gain /= 1 + NumberOf(numbers, "gain");
    return true;
  };
  effect.numbers = [](const EffectSite&, const Eigen::VectorXd& p) {
    return EffectNumbers{{"gain", p[0]}};
  };
  effect.unfit = WhyNotRecorded;
  effect.plausible = IsOfAConstant;
  effect.experiment = "a known payload, held and moved";
  return effect;
}

}  // namespace effects
}  // namespace armcal

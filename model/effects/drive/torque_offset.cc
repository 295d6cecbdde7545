#include "model/effects/effect_parts.h"

namespace armcal {
inline namespace effects {

// logged = given + offset: an amplifier or torque sensor whose zero is off.
Effect TorqueOffset() {
  Effect effect;
  effect.name = "torque_offset";
  effect.nature = Effect::Nature::kRecording;
  effect.law = "tau = offset";
  effect.shows = "any motion, beside gravity that changes sign";
  effect.parameters = {Linear("offset", "E", ShareOfTorque(.05))};
  effect.unfit = WhyNotRecorded;
  effect.of_the_drive = true;
  effect.apply = [](const EffectSite& site, const Eigen::VectorXd& p,
                    SimulatedRobot* robot) {
    const double offset = p[0];
    AddActuator(
        site, [=](double commanded) { return commanded - offset; },
        [=](double given) { return given + offset; }, robot);
  };
  effect.joint_term = JointTerm::kOffset;
  effect.numbers = [](const EffectSite&, const Eigen::VectorXd& p) {
    return EffectNumbers{{"offset", p[0]}};
  };
  effect.experiment = "poses in which gravity does not load the joint";
  return effect;
}

}  // namespace effects
}  // namespace armcal

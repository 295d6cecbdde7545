#include "model/effects/effect_parts.h"

namespace armcal {
inline namespace effects {

namespace {

// Of one motor it is that motor's gain, and of two what fits one joint's torque
// fits the other's a little: on double pendulums changes of one joint's
// friction or gain were told as this.
std::string WhyNotOfSeveral(const EffectSite& site) {
  int recorded = 0;
  for (int j = 0; j < site.robot->num_joints(); ++j) {
    recorded += WhyNotRecorded({site.robot, j, site.scale}).empty();
  }
  return recorded > 2 ? "" : "fewer than three joints' torques are recorded";
}

}  // namespace

// logged = (1 + gain) given, of all joints: torques in another unit than
// assumed, or one constant for all drives (currents read as their peaks for
// their rms are sqrt(2) too large).
Effect TorqueGainOfAllJoints() {
  Effect effect;
  effect.name = "torque_gain_of_all_joints";
  effect.scope = Effect::Scope::kRobot;
  effect.nature = Effect::Nature::kRecording;
  effect.law = "tau = gain tau_given, of all joints";
  effect.shows = "any motion, against a robot whose masses are known";
  effect.parameters = {
      Linear("gain", "1", [](const EffectSite&) { return .05; })};
  effect.apply = [](const EffectSite& site, const Eigen::VectorXd& p,
                    SimulatedRobot* robot) {
    for (int j = 0; j < site.robot->num_joints(); ++j) {
      AddGain({site.robot, j, site.scale}, p[0], robot);
    }
  };
  effect.unfit = WhyNotOfSeveral;
  effect.estimates_a_factor = true;
  effect.plausible = IsOfAMotorConstant;
  effect.if_joints_disagree = "gains of single drives";
  effect.experiment = "a known payload, held and moved";
  return effect;
}

}  // namespace effects
}  // namespace armcal

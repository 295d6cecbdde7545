#include "model/effects/effect_parts.h"

namespace armcal {
inline namespace effects {

// given' = (commanded - given) / delay, in all joints: the lag of a current
// loop, late by `delay` at frequencies far below 1 / delay. A negative one is
// the log's: torque recorded that much later than the motors gave it.
Effect Delay() {
  Effect effect;
  effect.name = "delay";
  effect.scope = Effect::Scope::kRobot;
  effect.law = "tau = delay d(tau_given)/dt";
  effect.shows = "torques that change fast";
  effect.parameters = {
      Linear("delay", "s", [](const EffectSite&) { return .002; })};
  effect.apply = [](const EffectSite& site, const Eigen::VectorXd& p,
                    SimulatedRobot* robot) {
    const int n = site.robot->num_joints();
    const double delay = p[0];
    if (delay <= 0) {
      robot->torque_delay -= delay;
      return;
    }
    robot->actuators.push_back(
        {Eigen::VectorXd::Zero(n), [=](const ArmInstant&, const double* given,
                                       double* rate, Eigen::VectorXd* torque) {
           for (int j = 0; j < n; ++j) {
             rate[j] = ((*torque)[j] - given[j]) / delay;
             (*torque)[j] = given[j];
           }
         }});
  };
  effect.experiment = "fast motion of small amplitude";
  return effect;
}

}  // namespace effects
}  // namespace armcal

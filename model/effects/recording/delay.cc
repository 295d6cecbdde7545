#include "model/effects/effect_parts.h"

namespace armcal {
inline namespace effects {

// Torque is recorded `delay` before the motors give it, in all joints: what was
// asked of a current loop that lags behind (a simulation lets it lag), or,
// where negative, what a log holds too late.
Effect Delay() {
  Effect effect;
  effect.name = "delay";
  effect.scope = Effect::Scope::kRobot;
  effect.nature = Effect::Nature::kRecording;
  effect.law = "tau = tau_given(t + delay) - tau_given(t)";
  effect.shows = "torques that change fast";
  effect.parameters = {
      Linear("delay", "s", [](const EffectSite&) { return .002; })};
  // What turns at f Hz is off by pi f delay from the tangent at 0, by a third
  // where 30 ms meet 3 Hz.
  effect.larger_sizes = {-40, -15, 15, 40};
  effect.apply = [](const EffectSite&, const Eigen::VectorXd& p,
                    SimulatedRobot* robot) { robot->torque_delay -= p[0]; };
  effect.numbers = [](const EffectSite&, const Eigen::VectorXd& p) {
    return EffectNumbers{{"delay", p[0]}};
  };
  // What friction or play holds back at reversals is late by a time that each
  // joint has for itself; a clock is late by one for all.
  effect.if_joints_disagree =
      "friction that lags at reversals (presliding) or play of some joints "
      "(backlash)";
  effect.if_of_each_joint = "presliding";
  effect.if_positive = "motors give the commanded torque late";
  effect.if_negative = "the log has torque late";
  effect.moves_reversals = true;
  effect.experiment = "fast motion of small amplitude";
  return effect;
}

}  // namespace effects
}  // namespace armcal

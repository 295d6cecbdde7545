#include "model/effects/effect_parts.h"

namespace armcal {
inline namespace effects {

// tau = stiffness q - preload: a spring of a balancer, stiffness times its
// neutral position being the preload.
Effect Spring() {
  Effect effect;
  effect.name = "spring";
  effect.nature = Effect::Nature::kLaw;
  effect.law = "tau = stiffness (q - neutral)";
  effect.shows = "slow motion over the joint's whole range";
  effect.parameters = {Linear(
                           "stiffness", "E/P",
                           [](const EffectSite& site) {
                             return .05 * TorqueScale(site) / Radian(site);
                           },
                           EffectParameter::Sign::kPositive),
                       Linear("preload", "E", ShareOfTorque(.05))};
  effect.apply = [](const EffectSite& site, const Eigen::VectorXd& p,
                    SimulatedRobot* robot) {
    const int j = site.joint;
    const double stiffness = p[0], preload = p[1];
    AddTorque(
        site,
        [=](const ArmInstant& at) {
          return preload - stiffness * at.position[j];
        },
        robot);
  };
  effect.estimates = [](const EffectSite& site, const Eigen::VectorXd& p) {
    return std::vector<EffectEstimate>{
        {"stiffness", UnitAt(site, "E/P"), p[0]},
        {"neutral", UnitAt(site, "P"), p[1] / p[0]}};
  };
  effect.means = {"torque_offset"};
  effect.set_drive = [](const EffectNumbers& numbers, JointDrive* drive) {
    const double stiffness = NumberOf(numbers, "stiffness");
    if (stiffness <= 0) return false;
    drive->rest = NumberOf(numbers, "preload") / stiffness;
    drive->stiffness = stiffness;
    return true;
  };
  effect.stand_ins = {JointTerm::kOffset};
  effect.numbers = [](const EffectSite&, const Eigen::VectorXd& p) {
    return EffectNumbers{{"stiffness", p[0]}, {"preload", p[1]}};
  };
  effect.experiment = "slow sweeps over the whole range, both ways";
  return effect;
}

}  // namespace effects
}  // namespace armcal

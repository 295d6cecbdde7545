#include "model/effects/effect_parts.h"

namespace armcal {
inline namespace effects {

// tau = -viscous v: drag in a lubricant that keeps its viscosity (Olsson et al.
// 1998). Added to what the joint has.
Effect ViscousFriction() {
  Effect effect;
  effect.name = "viscous_friction";
  effect.nature = Effect::Nature::kParameter;
  effect.law = "tau = viscous v";
  effect.shows = "motion at several speeds";
  effect.parameters = {Linear("viscous", "E s/P", ShareOfDrag(.05))};
  effect.apply = [](const EffectSite& site, const Eigen::VectorXd& p,
                    SimulatedRobot* robot) {
    const int j = site.joint;
    const double viscous = p[0];
    AddFriction(
        site, [=](const ArmInstant& at) { return -viscous * at.velocity[j]; },
        robot);
  };
  effect.joint_term = JointTerm::kViscous;
  effect.numbers = [](const EffectSite&, const Eigen::VectorXd& p) {
    return EffectNumbers{{"viscous", p[0]}};
  };
  effect.experiment = "constant velocities, slow and fast, both ways";
  return effect;
}

}  // namespace effects
}  // namespace armcal

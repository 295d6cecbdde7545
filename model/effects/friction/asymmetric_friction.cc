#include <cmath>

#include "model/effects/effect_parts.h"

namespace armcal {
inline namespace effects {

// tau = -asymmetric |v|: beside viscous friction, drag that differs between the
// two directions.
Effect AsymmetricFriction() {
  Effect effect;
  effect.name = "asymmetric_friction";
  effect.nature = Effect::Nature::kLaw;
  effect.law = "tau = asymmetric |v|";
  effect.shows = "motion both ways at several speeds";
  effect.parameters = {Linear("asymmetric", "E s/P", ShareOfDrag(.05))};
  effect.apply = [](const EffectSite& site, const Eigen::VectorXd& p,
                    SimulatedRobot* robot) {
    const int j = site.joint;
    const double asymmetric = p[0];
    AddFriction(
        site,
        [=](const ArmInstant& at) {
          return -asymmetric * std::abs(at.velocity[j]);
        },
        robot);
  };
  effect.stand_ins = {JointTerm::kViscous, JointTerm::kOffset};
  effect.means = {"viscous_friction"};
  effect.numbers = [](const EffectSite&, const Eigen::VectorXd& p) {
    return EffectNumbers{{"asymmetric", p[0]}};
  };
  effect.experiment = "the same constant velocities both ways, slow and fast";
  return effect;
}

}  // namespace effects
}  // namespace armcal

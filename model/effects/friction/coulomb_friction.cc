#include <cmath>

#include "model/effects/effect_parts.h"

namespace armcal {
inline namespace effects {

// tau = -coulomb tanh(v / w): dry friction, which changes sign within the
// joint's own width w. Added to what the joint has.
Effect CoulombFriction() {
  Effect effect;
  effect.name = "coulomb_friction";
  effect.nature = Effect::Nature::kParameter;
  effect.law = "tau = coulomb sign(v)";
  effect.shows = "motion both ways";
  effect.parameters = {Linear("coulomb", "E", ShareOfTorque(.05))};
  effect.apply = [](const EffectSite& site, const Eigen::VectorXd& p,
                    SimulatedRobot* robot) {
    const int j = site.joint;
    const double coulomb = p[0], w = site.scale->width[j];
    AddFriction(
        site,
        [=](const ArmInstant& at) {
          return -coulomb * std::tanh(at.velocity[j] / w);
        },
        robot);
  };
  effect.joint_term = JointTerm::kCoulomb;
  effect.numbers = [](const EffectSite& site, const Eigen::VectorXd& p) {
    return EffectNumbers{{"coulomb", p[0]},
                         {"width", site.scale->width[site.joint]}};
  };
  effect.experiment = "slow constant velocities, both ways";
  return effect;
}

}  // namespace effects
}  // namespace armcal

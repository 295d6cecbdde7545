#include <cmath>

#include "model/effects/effect_parts.h"

namespace armcal {
inline namespace effects {

// tau = -load_friction |load| tanh(v / w), load what the drive hands to its
// link: Coulomb's law for teeth pressed together (Hamon, Gautier, Garrec 2010).
Effect LoadFriction() {
  Effect effect;
  effect.name = "load_friction";
  effect.nature = Effect::Nature::kLaw;
  effect.law = "tau = load_friction |load| sign(v)";
  effect.shows = "motion both ways under large and small loads";
  effect.parameters = {Linear(
      "load_friction", "1", [](const EffectSite&) { return .05; },
      EffectParameter::Sign::kPositive)};
  effect.apply = [](const EffectSite& site, const Eigen::VectorXd& p,
                    SimulatedRobot* robot) {
    const int j = site.joint;
    const double mu = p[0], w = site.scale->width[j];
    AddFriction(
        site,
        [=](const ArmInstant& at) {
          return -mu * std::abs(at.load[j]) * std::tanh(at.velocity[j] / w);
        },
        robot);
  };
  effect.means = {"coulomb_friction"};
  effect.stand_ins = {JointTerm::kViscous, JointTerm::kCoulomb};
  effect.numbers = [](const EffectSite& site, const Eigen::VectorXd& p) {
    return EffectNumbers{{"load_friction", p[0]},
                         {"width", site.scale->width[site.joint]}};
  };
  effect.experiment =
      "the same slow motion both ways with the arm stretched and folded";
  return effect;
}

}  // namespace effects
}  // namespace armcal

#include <cmath>

#include "model/effects/effect_parts.h"

namespace armcal {
inline namespace effects {

// tau = -(sine sin(n q) + cosine cos(n q)) tanh(v / w): beside Coulomb
// friction, n spots per 2 pi of the joint that are tighter than others.
Effect PositionFriction() {
  Effect effect;
  effect.name = "position_friction";
  effect.nature = Effect::Nature::kLaw;
  effect.law = "tau = (sine sin(n q) + cosine cos(n q)) sign(v)";
  effect.shows = "slow motion both ways over the joint's whole range";
  effect.parameters = {Linear("sine", "E", ShareOfTorque(.05)),
                       Linear("cosine", "E", ShareOfTorque(.05)),
                       Gridded("harmonic", "1/P", [](const EffectSite& site) {
                         const double r = Radian(site);
                         return std::vector<double>{1 / r, 2 / r, 3 / r, 4 / r};
                       })};
  effect.apply = [](const EffectSite& site, const Eigen::VectorXd& p,
                    SimulatedRobot* robot) {
    const int j = site.joint;
    const double a = p[0], b = p[1], n = p[2], w = site.scale->width[j];
    AddFriction(
        site,
        [=](const ArmInstant& at) {
          const double x = n * at.position[j];
          return -(a * std::sin(x) + b * std::cos(x)) *
                 std::tanh(at.velocity[j] / w);
        },
        robot);
  };
  // By how much tight spots exceed loose ones, and where they are:
  // friction / 2 cos(n q - phase).
  effect.estimates = [](const EffectSite& site, const Eigen::VectorXd& p) {
    return std::vector<EffectEstimate>{
        {"friction", UnitAt(site, "E"), 2 * Amplitude(p[0], p[1])},
        {"harmonic", UnitAt(site, "1/P"), p[2]},
        {"phase", "rad", Phase(p[1], p[0])}};
  };
  effect.means = {"coulomb_friction"};
  effect.stand_ins = {JointTerm::kViscous, JointTerm::kCoulomb};
  effect.numbers = [](const EffectSite& site, const Eigen::VectorXd& p) {
    return EffectNumbers{{"sine", p[0]},
                         {"cosine", p[1]},
                         {"harmonic", p[2]},
                         {"width", site.scale->width[site.joint]}};
  };
  effect.experiment = "slow sweeps over the whole range and back";
  return effect;
}

}  // namespace effects
}  // namespace armcal

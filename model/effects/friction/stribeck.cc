#include <algorithm>
#include <cmath>

#include "model/effects/effect_parts.h"

namespace armcal {
inline namespace effects {

// tau = -stribeck exp(-(v / stribeck_velocity)^2) tanh(v / w): more friction
// near standstill than the film of oil leaves at speed (Armstrong-Helouvry
// 1991).
Effect Stribeck() {
  Effect effect;
  effect.name = "stribeck";
  effect.nature = Effect::Nature::kLaw;
  effect.law = "tau = stribeck exp(-(v/stribeck_velocity)^2) sign(v)";
  effect.shows = "slow motion, reversals and starts";
  effect.parameters = {
      Linear("stribeck", "E", ShareOfTorque(.05),
             EffectParameter::Sign::kPositive),
      // From where it is told from the width to where it is a parabola.
      Gridded("stribeck_velocity", "P/s", [](const EffectSite& site) {
        const double low =
            std::max(2 * site.scale->width[site.joint], .03 * SpeedScale(site));
        return GeometricGrid(low, std::max(1.5 * SpeedScale(site), 3 * low), 7);
      })};
  effect.apply = [](const EffectSite& site, const Eigen::VectorXd& p,
                    SimulatedRobot* robot) {
    const int j = site.joint;
    const double stribeck = p[0], vs = p[1], w = site.scale->width[j];
    AddFriction(
        site,
        [=](const ArmInstant& at) {
          const double v = at.velocity[j];
          return -stribeck * std::exp(-v * v / (vs * vs)) * std::tanh(v / w);
        },
        robot);
  };
  effect.near_zero = true;
  effect.stand_ins = {JointTerm::kViscous, JointTerm::kCoulomb};
  effect.means = {"coulomb_friction", "viscous_friction"};
  effect.set_drive = [](const EffectNumbers& numbers, JointDrive* drive) {
    const double stribeck = NumberOf(numbers, "stribeck");
    if (stribeck <= 0) return false;
    drive->bristles.push_back(BristleFriction::Stribeck(
        stribeck, NumberOf(numbers, "stribeck_velocity"),
        NumberOf(numbers, "width")));
    return true;
  };
  effect.numbers = [](const EffectSite& site, const Eigen::VectorXd& p) {
    return EffectNumbers{{"stribeck", p[0]},
                         {"stribeck_velocity", p[1]},
                         {"width", site.scale->width[site.joint]}};
  };
  effect.experiment = "constant velocities from creeping to usual, both ways";
  return effect;
}

}  // namespace effects
}  // namespace armcal

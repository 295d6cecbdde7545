#include <cmath>

#include "model/effects/effect_parts.h"

namespace armcal {
inline namespace effects {

// tau = -quadratic v |v|: churning of a fluid at high Reynolds number.
Effect QuadraticFriction() {
  Effect effect;
  effect.name = "quadratic_friction";
  effect.nature = Effect::Nature::kLaw;
  effect.law = "tau = quadratic v |v|";
  effect.shows = "motion at several speeds, the highest included";
  effect.parameters = {Linear(
      "quadratic", "E s^2/P^2",
      [](const EffectSite& site) {
        const double speed = SpeedScale(site);
        return .05 * TorqueScale(site) / (speed * speed);
      },
      EffectParameter::Sign::kPositive)};
  effect.apply = [](const EffectSite& site, const Eigen::VectorXd& p,
                    SimulatedRobot* robot) {
    const int j = site.joint;
    const double quadratic = p[0];
    AddFriction(
        site,
        [=](const ArmInstant& at) {
          const double v = at.velocity[j];
          return -quadratic * v * std::abs(v);
        },
        robot);
  };
  effect.stand_ins = {JointTerm::kViscous, JointTerm::kCoulomb};
  effect.means = {"viscous_friction"};
  effect.set_drive = [](const EffectNumbers& numbers, JointDrive* drive) {
    drive->quadratic += NumberOf(numbers, "quadratic");
    return true;
  };
  effect.numbers = [](const EffectSite&, const Eigen::VectorXd& p) {
    return EffectNumbers{{"quadratic", p[0]}};
  };
  effect.experiment = "constant velocities up to the joint's limit";
  return effect;
}

}  // namespace effects
}  // namespace armcal

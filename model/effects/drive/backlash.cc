#include <cmath>

#include "model/dynamics/flanked_spring.h"
#include "model/effects/effect_parts.h"

namespace armcal {
inline namespace effects {

namespace {

double ContactStiffness(const EffectSite& site, const Eigen::VectorXd& p) {
  return TorqueScale(site) / (p[1] * p[0]);
}

double ContactDamping(const EffectSite& site, const Eigen::VectorXd& p) {
  return 2 * p[2] * std::sqrt(ContactStiffness(site, p) * CarriedInertia(site));
}

Transmission DeadZone(int joint, const FlankedSpring& spring) {
  Transmission law;
  law.joint = joint;
  law.torque = spring;
  law.initial_deflection = [spring](double load) {
    return load == 0
               ? 0
               : std::copysign(spring.gap / 2, load) + load / spring.stiffness;
  };
  law.stiffest = spring.stiffness;
  return law;
}

}  // namespace

// A dead zone between flanks that yield: no torque while the motor is within
// backlash / 2 of its link, k (|d| - backlash / 2) + c |d|' beyond, never a
// pull (Nordin and Gutman 2002). `yield` is the share of the gap by which
// flanks give under the joint's usual torque: so deflections, and torques, are
// in proportion to the gap. `damping_ratio` is that of a flank's spring with
// the motor held; of .2 a link that strikes it bounces at .57 of its speed, and
// when it comes back tells much of the gap. A simulation needs an armature of
// the joint.
Effect Backlash() {
  Effect effect;
  effect.name = "backlash";
  effect.nature = Effect::Nature::kLaw;
  effect.law = "tau = ID(q - backlash/2 sign(load)) - ID(q)";
  effect.shows = "loads that change sign";
  effect.parameters = {
      Linear(
          "backlash", "P",
          [](const EffectSite& site) { return .0005 * Radian(site); },
          EffectParameter::Sign::kPositive),
      Gridded("yield", "1",
              [](const EffectSite&) {
                return std::vector<double>{.07, .25};
              }),
      Refined("damping_ratio", "1", {.02, .2, 1.5})};
  // When a gap is crossed depends on its size: neighbours look alike only when
  // they are near.
  effect.larger_sizes = GeometricGrid(std::sqrt(2), 256, 16);
  effect.apply = [](const EffectSite& site, const Eigen::VectorXd& p,
                    SimulatedRobot* robot) {
    if (p[0] <= 0) return;
    const FlankedSpring spring = {p[0], ContactStiffness(site, p),
                                  ContactDamping(site, p)};
    robot->transmissions.push_back(DeadZone(site.joint, spring));
  };
  effect.estimates = [](const EffectSite& site, const Eigen::VectorXd& p) {
    return std::vector<EffectEstimate>{
        {"backlash", UnitAt(site, "P"), p[0]},
        {"contact_stiffness", UnitAt(site, "E/P"), ContactStiffness(site, p)}};
  };
  effect.set_drive = [](const EffectNumbers& numbers, JointDrive* drive) {
    if (drive->gear) return false;
    drive->gear = {NumberOf(numbers, "gap"), NumberOf(numbers, "stiffness"),
                   NumberOf(numbers, "damping")};
    return true;
  };
  effect.proportional = false;
  effect.means = {"armature"};
  effect.numbers = [](const EffectSite& site, const Eigen::VectorXd& p) {
    return EffectNumbers{{"gap", p[0]},
                         {"stiffness", ContactStiffness(site, p)},
                         {"damping", ContactDamping(site, p)}};
  };
  effect.experiment =
      "slow motion through poses in which the load changes sign, at 100 Hz or "
      "more; an encoder at the link";
  return effect;
}

}  // namespace effects
}  // namespace armcal

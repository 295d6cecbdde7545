#include "model/effects/effect_parts.h"

namespace armcal {
inline namespace effects {

// tau = stiffness q: a spring of a balancer. Its neutral position is in the
// joint's offset.
Effect Spring() {
  Effect effect;
  effect.name = "spring";
  effect.law = "tau = stiffness q";
  effect.shows = "slow motion over the joint's whole range";
  effect.parameters = {Linear("stiffness", "E/P", [](const EffectSite& site) {
    return .05 * TorqueScale(site) / Radian(site);
  })};
  effect.apply = [](const EffectSite& site, const Eigen::VectorXd& p,
                    SimulatedRobot* robot) {
    const int j = site.joint;
    const double stiffness = p[0];
    AddTorque(
        site, [=](const ArmInstant& at) { return -stiffness * at.position[j]; },
        robot);
  };
  effect.experiment = "slow sweeps over the whole range, both ways";
  return effect;
}

}  // namespace effects
}  // namespace armcal

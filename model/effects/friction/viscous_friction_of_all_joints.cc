#include <algorithm>

#include "model/effects/effect_parts.h"

namespace armcal {
inline namespace effects {

namespace {

// Of one joint it is that joint's viscous friction, and two may change alike by
// chance.
std::string WhyNotShared(const EffectSite& site) {
  const std::vector<Link>& links = site.robot->links;
  const auto viscous =
      std::count_if(links.begin(), links.end(),
                    [](const Link& link) { return link.joint.viscous > 0; });
  return viscous > 2 ? "" : "fewer than three joints have viscous friction";
}

// Gears drag some ten times as much at frost as when they are warm.
bool IsOfTemperature(const EffectSite&,
                     const std::vector<EffectEstimate>& estimates) {
  return estimates[0].value > -.9 && estimates[0].value < 9;
}

}  // namespace

// viscous (1 + share), of all joints: the same grease is as warm in all of
// them. Its viscosity falls by some percent per kelvin, while dry friction
// hardly depends on temperature (Bittencourt, Wernholt, Sander-Tavallaey and
// Brogardh 2010; Simoni et al. 2017).
Effect ViscousFrictionOfAllJoints() {
  Effect effect;
  effect.name = "viscous_friction_of_all_joints";
  effect.scope = Effect::Scope::kRobot;
  effect.nature = Effect::Nature::kDay;
  effect.law = "tau = share viscous v, of all joints";
  effect.shows = "fast motion of several joints";
  effect.parameters = {
      Linear("share", "1", [](const EffectSite&) { return .05; })};
  effect.apply = [](const EffectSite&, const Eigen::VectorXd& p,
                    SimulatedRobot* robot) {
    for (Link& link : robot->robot.links) link.joint.viscous *= 1 + p[0];
  };
  effect.unfit = WhyNotShared;
  effect.estimates_a_factor = true;
  effect.plausible = IsOfTemperature;
  effect.if_joints_disagree =
      "friction of single joints (wear, a seal), or joints of which not all "
      "are as warm";
  effect.experiment = "the same motion again, warm and cold";
  return effect;
}

}  // namespace effects
}  // namespace armcal

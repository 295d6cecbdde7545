#include <cmath>

#include "model/effects/effect_parts.h"

namespace armcal {
inline namespace effects {

namespace {

// A link with a tenth of its mass left, or with more than twice its own,
// carries something or has lost it: another effect.
bool IsOfTheLink(const EffectSite&,
                 const std::vector<EffectEstimate>& estimates) {
  return estimates[0].value > -.9 && estimates[0].value < 1;
}

}  // namespace

// A link whose mass, first moments and inertia are (1 + share) of the robot
// file's.
Effect LinkInertia() {
  Effect effect;
  effect.name = "link_inertia";
  effect.nature = Effect::Nature::kParameter;
  effect.of_construction = true;
  effect.law = "tau = share ID(this link alone)";
  effect.shows = "gravity on the joints before, and their accelerations";
  effect.parameters = {
      Linear("share", "1", [](const EffectSite&) { return .1; })};
  effect.apply = [](const EffectSite& site, const Eigen::VectorXd& p,
                    SimulatedRobot* robot) {
    InertialParameters& link = robot->robot.links[site.joint].inertial;
    link = InertialParameters::FromVector((1 + p[0]) * link.ToVector());
  };
  effect.estimates = [](const EffectSite& site, const Eigen::VectorXd& p) {
    const double mass = site.robot->links[site.joint].inertial.mass;
    return std::vector<EffectEstimate>{{"share", "1", p[0]},
                                       {"mass", "kg", p[0] * mass}};
  };
  effect.unfit = [](const EffectSite& site) -> std::string {
    return site.robot->links[site.joint].inertial.ToVector().isZero()
               ? "the link has no mass"
               : WhyNotCarried(site);
  };
  effect.plausible = IsOfTheLink;
  effect.experiment = "poses of the joints before, held, and swung";
  return effect;
}

}  // namespace effects
}  // namespace armcal

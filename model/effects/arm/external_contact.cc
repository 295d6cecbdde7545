#include <cmath>

#include "model/effects/effect_parts.h"

namespace armcal {
inline namespace effects {

namespace {

std::vector<EffectEstimate> ContactEstimates(const EffectSite&,
                                             const Eigen::VectorXd& p) {
  return {{"force", "N", p.head<3>().norm()},
          {"time", "s", p[3]},
          {"width", "s", p[4]},
          {"force_x", "N", p[0]},
          {"force_y", "N", p[1]},
          {"force_z", "N", p[2]}};
}

}  // namespace

// force exp(-((t - time) / width)^2) on the tool's origin, in W, as the
// environment acts on the arm: a push that comes and goes once.
Effect ExternalContact() {
  Effect effect;
  effect.name = "external_contact";
  effect.scope = Effect::Scope::kRobot;
  effect.nature = Effect::Nature::kEvent;
  effect.law = "tau = -J' force exp(-((t - time)/width)^2)";
  effect.shows = "a span of time that does not repeat";
  const auto size = [](const EffectSite& site) {
    return .05 * 9.81 * MovingMass(*site.robot);
  };
  effect.parameters = {
      Linear("force_x", "N", size), Linear("force_y", "N", size),
      Linear("force_z", "N", size),
      Searched("time", "s", EffectParameter::Search::kTime,
               [](const EffectSite& site) {
                 return (site.scale->begin + site.scale->end) / 2;
               }),
      Searched("width", "s", EffectParameter::Search::kDuration,
               [](const EffectSite&) { return .5; })};
  effect.apply = [](const EffectSite& site, const Eigen::VectorXd& p,
                    SimulatedRobot* robot) {
    constexpr double kGone = 6;  // widths after which nothing is left
    const Eigen::Vector3d force = p.head<3>();
    const double time = p[3], width = p[4];
    WrenchLaw law;
    law.attachment = {site.robot->num_joints() - 1,
                      site.robot->X_LT.translation()};
    law.wrench = [=](const PointInstant& at, const double*, double*) {
      Wrench wrench;
      const double x = (at.t - time) / width;
      if (std::abs(x) < kGone) wrench.force = std::exp(-x * x) * force;
      return wrench;
    };
    robot->wrenches.push_back(law);
  };
  effect.estimates = ContactEstimates;
  effect.is_contact = true;
  effect.experiment = "the same motion again";
  return effect;
}

}  // namespace effects
}  // namespace armcal

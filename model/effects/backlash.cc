#include <algorithm>
#include <cmath>

#include "model/effects/effect_parts.h"

namespace armcal {
inline namespace effects {

namespace {

constexpr double kRounding = .05;    // of the gap: corners of the dead zone
constexpr double kDampingRatio = 1;  // of a flank, with the motor held

// SoftPlus and its slope, at once.
struct Corner {
  double value, slope;
};

Corner CornerAt(double x) {
  constexpr double kFar = 25;
  if (std::abs(x) > kFar) return {std::max(x, 0.), x > 0 ? 1. : 0.};
  const double tail = std::exp(-std::abs(x));
  const double rounded =
      tail < 1e-8 ? tail * (1 - tail / 2) : std::log1p(tail);  // the same
  return {std::max(x, 0.) + rounded, (x > 0 ? 1 : tail) / (1 + tail)};
}

double ContactStiffness(const EffectSite& site, const Eigen::VectorXd& p) {
  return TorqueScale(site) / (p[1] * p[0]);
}

Transmission DeadZone(int joint, double gap, double k, double damping) {
  const double w = kRounding * gap;
  Transmission law;
  law.joint = joint;
  law.torque = [=](double d, double rate, const double*, double*) {
    const Corner ahead = CornerAt((d - gap / 2) / w);
    const Corner behind = CornerAt((-d - gap / 2) / w);
    const double pressed = w * (ahead.value - behind.value);
    const double touching = ahead.slope + behind.slope;
    return k * pressed + damping * touching * rate;
  };
  law.initial_deflection = [=](double load) {
    return load == 0 ? 0 : std::copysign(gap / 2, load) + load / k;
  };
  law.stiffest = k;
  return law;
}

}  // namespace

// A dead zone between flanks that yield: no torque while the motor is within
// backlash / 2 of its link, k (|d| - backlash / 2) beyond (Nordin and Gutman
// 2002), corners rounded. `yield` is the share of the gap by which flanks give
// under the joint's usual torque: so deflections, and torques, are in
// proportion to the gap. A simulation needs an armature of the joint.
Effect Backlash() {
  Effect effect;
  effect.name = "backlash";
  effect.law = "tau = ID(q - backlash/2 sign(load)) - ID(q)";
  effect.shows = "loads that change sign";
  effect.parameters = {
      Linear(
          "backlash", "P",
          [](const EffectSite& site) { return .0005 * Radian(site); },
          EffectParameter::Sign::kPositive),
      Gridded("yield", "1", [](const EffectSite&) {
        return std::vector<double>{.07, .25};
      })};
  // When a gap is crossed depends on its size: neighbours look alike only when
  // they are near.
  effect.larger_sizes = GeometricGrid(std::sqrt(2), 256, 16);
  effect.apply = [](const EffectSite& site, const Eigen::VectorXd& p,
                    SimulatedRobot* robot) {
    if (p[0] <= 0) return;
    const double k = ContactStiffness(site, p);
    const double damping =
        2 * kDampingRatio * std::sqrt(k * CarriedInertia(site));
    robot->transmissions.push_back(DeadZone(site.joint, p[0], k, damping));
  };
  effect.estimates = [](const EffectSite& site, const Eigen::VectorXd& p) {
    return std::vector<EffectEstimate>{
        {"backlash", UnitAt(site, "P"), p[0]},
        {"contact_stiffness", UnitAt(site, "E/P"), ContactStiffness(site, p)}};
  };
  effect.means = {"armature"};
  effect.experiment =
      "slow motion through poses in which the load changes sign, at 100 Hz or "
      "more; an encoder at the link";
  return effect;
}

}  // namespace effects
}  // namespace armcal

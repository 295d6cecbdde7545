#include <cmath>

#include "model/effects/effect_parts.h"

namespace armcal {
inline namespace effects {

// tau = sine sin(2 pi f t) + cosine cos(2 pi f t) on the arm: a shaker at one
// frequency whatever the arm does.
Effect Vibration() {
  Effect effect;
  effect.name = "vibration";
  effect.nature = Effect::Nature::kDay;
  effect.law = "tau = -sine sin(2 pi f t) - cosine cos(2 pi f t)";
  effect.shows = "any recording of many periods, at rest too";
  effect.parameters = {
      Linear("sine", "E", ShareOfTorque(.02)),
      Linear("cosine", "E", ShareOfTorque(.02)),
      Searched("frequency", "Hz", EffectParameter::Search::kTimeFrequency,
               [](const EffectSite&) { return 5.; })};
  effect.apply = [](const EffectSite& site, const Eigen::VectorXd& p,
                    SimulatedRobot* robot) {
    const double a = p[0], b = p[1], omega = 2 * M_PI * p[2];
    AddTorque(
        site,
        [=](const ArmInstant& at) {
          return a * std::sin(omega * at.t) + b * std::cos(omega * at.t);
        },
        robot);
  };
  effect.estimates = [](const EffectSite& site, const Eigen::VectorXd& p) {
    return std::vector<EffectEstimate>{
        {"amplitude", UnitAt(site, "E"), Amplitude(p[0], p[1])},
        {"frequency", "Hz", p[2]},
        {"phase", "rad", Phase(p[0], p[1])}};
  };
  effect.numbers = [](const EffectSite&, const Eigen::VectorXd& p) {
    return EffectNumbers{{"sine", p[0]}, {"cosine", p[1]}, {"frequency", p[2]}};
  };
  effect.experiment = "the arm at rest";
  return effect;
}

}  // namespace effects
}  // namespace armcal

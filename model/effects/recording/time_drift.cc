#include <cmath>

#include "model/effects/effect_parts.h"

namespace armcal {
inline namespace effects {

// tau = drift (1 - exp(-t / T)) / (1 - exp(-D / T)), from the begin of the log
// to its end at D: a bias that settles, or with large T one that grows evenly.
Effect TimeDrift() {
  Effect effect;
  effect.name = "time_drift";
  effect.nature = Effect::Nature::kRecording;
  effect.law = "tau = drift (1 - exp(-t/T)), drift at the end of the log";
  effect.shows = "minutes of recording";
  effect.parameters = {
      Linear("drift", "E", ShareOfTorque(.05)),
      Gridded("time_constant", "s", [](const EffectSite& site) {
        return GeometricGrid(.1 * Duration(site), 3 * Duration(site), 4);
      })};
  effect.apply = [](const EffectSite& site, const Eigen::VectorXd& p,
                    SimulatedRobot* robot) {
    const double begin = site.scale->begin, T = p[1];
    const double drift = p[0] / -std::expm1(-Duration(site) / T);
    AddTorque(
        site,
        [=](const ArmInstant& at) {
          return drift * std::expm1(-(at.t - begin) / T);
        },
        robot);
  };
  effect.estimates = [](const EffectSite& site, const Eigen::VectorXd& p) {
    return std::vector<EffectEstimate>{
        {"drift", UnitAt(site, "E"), p[0]},
        {"drift_rate", UnitAt(site, "E") + "/s", p[0] / Duration(site)},
        {"time_constant", "s", p[1]}};
  };
  effect.stand_ins = {JointTerm::kOffset};
  effect.numbers = [](const EffectSite& site, const Eigen::VectorXd& p) {
    return EffectNumbers{{"drift", p[0] / -std::expm1(-Duration(site) / p[1])},
                         {"time_constant", p[1]},
                         {"begin", site.scale->begin}};
  };
  effect.experiment = "the same motion or pose again and again";
  return effect;
}

}  // namespace effects
}  // namespace armcal

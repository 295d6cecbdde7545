#include <cmath>

#include "model/effects/effect_parts.h"

namespace armcal {
inline namespace effects {

// tau = sine sin(n q) + cosine cos(n q): cogging of a motor, mesh of a gear.
Effect TorqueRipple() {
  Effect effect;
  effect.name = "torque_ripple";
  effect.nature = Effect::Nature::kLaw;
  effect.law = "tau = sine sin(n q) + cosine cos(n q)";
  effect.shows = "slow motion over many periods of the ripple";
  effect.parameters = {
      Linear("sine", "E", ShareOfTorque(.02)),
      Linear("cosine", "E", ShareOfTorque(.02)),
      Searched("harmonic", "1/P", EffectParameter::Search::kPositionFrequency,
               [](const EffectSite& site) { return 20 / Radian(site); })};
  effect.apply = [](const EffectSite& site, const Eigen::VectorXd& p,
                    SimulatedRobot* robot) {
    const int j = site.joint;
    const double a = p[0], b = p[1], n = p[2];
    AddTorque(
        site,
        [=](const ArmInstant& at) {
          const double x = n * at.position[j];
          return -(a * std::sin(x) + b * std::cos(x));
        },
        robot);
  };
  // ripple sin(n q + phase).
  effect.estimates = [](const EffectSite& site, const Eigen::VectorXd& p) {
    return std::vector<EffectEstimate>{
        {"ripple", UnitAt(site, "E"), Amplitude(p[0], p[1])},
        {"harmonic", UnitAt(site, "1/P"), p[2]},
        {"phase", "rad", Phase(p[0], p[1])}};
  };
  effect.means = {"torque_offset"};
  effect.set_drive = [](const EffectNumbers& numbers, JointDrive* drive) {
    const double a = -NumberOf(numbers, "sine");
    const double b = -NumberOf(numbers, "cosine");
    drive->waves.push_back(
        {Amplitude(a, b), NumberOf(numbers, "harmonic"), Phase(a, b)});
    return true;
  };
  effect.stand_ins = {JointTerm::kOffset};
  effect.numbers = [](const EffectSite&, const Eigen::VectorXd& p) {
    return EffectNumbers{{"sine", p[0]}, {"cosine", p[1]}, {"harmonic", p[2]}};
  };
  effect.experiment = "a slow constant velocity over the whole range";
  return effect;
}

}  // namespace effects
}  // namespace armcal

#include <cmath>

#include "model/effects/effect_parts.h"

namespace armcal {
inline namespace effects {

// logged = given + gain logged_neighbour: a share of the neighbour's current in
// this joint's sensor.
Effect TorqueCrosstalk() {
  Effect effect;
  effect.name = "torque_crosstalk";
  effect.nature = Effect::Nature::kLaw;
  effect.law = "tau = gain tau_neighbour";
  effect.shows = "neighbours whose torques differ in time";
  effect.parameters = {Linear("gain", "1",
                              [](const EffectSite& site) {
                                EffectSite other = site;
                                double neighbours = 0;
                                for (const int k : Neighbours(site)) {
                                  other.joint = k;
                                  neighbours += TorqueScale(other);
                                }
                                if (neighbours == 0) return .05;
                                return .05 * TorqueScale(site) / neighbours;
                              }),
                       NeighbourParameter()};
  effect.apply = [](const EffectSite& site, const Eigen::VectorXd& p,
                    SimulatedRobot* robot) {
    const int j = site.joint, k = static_cast<int>(std::lround(p[1])) - 1;
    const double gain = p[0];
    robot->actuators.push_back({{},
                                [=](const ArmInstant&, const double*, double*,
                                    Eigen::VectorXd* torque) {
                                  (*torque)[j] -= gain * (*torque)[k];
                                }});
  };
  effect.unfit = WhyNoNeighbour;
  effect.numbers = [](const EffectSite&, const Eigen::VectorXd& p) {
    return EffectNumbers{{"gain", p[0]}, {"neighbour", p[1]}};
  };
  effect.experiment = "the neighbour loaded while this joint rests";
  return effect;
}

}  // namespace effects
}  // namespace armcal

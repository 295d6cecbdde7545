#include <cmath>

#include "model/effects/effect_parts.h"
#include "model/robot/saturating_parts.h"

namespace armcal {
inline namespace effects {

// tau = cable tanh((q - centre) / softness): a bundle that lies over to one
// side or the other; bounded, so that it does no harm beyond the data.
Effect Cable() {
  Effect effect;
  effect.name = "cable";
  effect.nature = Effect::Nature::kLaw;
  effect.law = "tau = cable tanh((q - centre)/softness)";
  effect.shows = "motion over the joint's whole range";
  effect.parameters = {
      Linear("cable", "E", ShareOfTorque(.05),
             EffectParameter::Sign::kPositive),
      Gridded("centre", "P",
              [](const EffectSite& site) {
                const double low = site.scale->low[site.joint];
                const double range = site.scale->high[site.joint] - low;
                std::vector<double> centres;  // beyond the motion, too
                for (double at = -.25; at < 1.5; at += .25) {
                  centres.push_back(low + at * range);
                }
                return centres;
              }),
      Gridded("softness", "P", [](const EffectSite& site) {
        return GeometricGrid(.1 * Radian(site), Radian(site), 3);
      })};
  effect.apply = [](const EffectSite& site, const Eigen::VectorXd& p,
                    SimulatedRobot* robot) {
    const int j = site.joint;
    const double cable = p[0], centre = p[1], softness = p[2];
    AddTorque(
        site,
        [=](const ArmInstant& at) {
          return -cable * std::tanh((at.position[j] - centre) / softness);
        },
        robot);
  };
  effect.means = {"torque_offset", "spring"};  // near its centre
  effect.stand_ins = {JointTerm::kOffset};
  effect.set_drive = [](const EffectNumbers& numbers, JointDrive* drive) {
    drive->bounded_springs.push_back(TanhSpring(NumberOf(numbers, "cable"),
                                                NumberOf(numbers, "centre"),
                                                NumberOf(numbers, "softness")));
    return true;
  };
  effect.numbers = [](const EffectSite&, const Eigen::VectorXd& p) {
    return EffectNumbers{{"cable", p[0]}, {"centre", p[1]}, {"softness", p[2]}};
  };
  effect.experiment = "slow sweeps over the whole range, both ways";
  return effect;
}

}  // namespace effects
}  // namespace armcal

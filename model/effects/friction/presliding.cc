#include <cmath>

#include "model/effects/effect_parts.h"

namespace armcal {
inline namespace effects {

// tau = -coulomb z, z' = v / displacement (1 - z sign(v)): bristles that bend
// before they slip (Dahl 1968).
Effect Presliding() {
  Effect effect;
  effect.name = "presliding";
  effect.nature = Effect::Nature::kLaw;
  effect.law = "tau = coulomb z, z' = v/displacement (1 - z sign(v))";
  effect.shows = "reversals and small motions";
  effect.parameters = {Linear("coulomb", "E", ShareOfTorque(.05),
                              EffectParameter::Sign::kPositive),
                       Gridded("displacement", "P", [](const EffectSite& site) {
                         return GeometricGrid(.0001 * Radian(site),
                                              .1 * Radian(site), 7);
                       })};
  effect.apply = [](const EffectSite& site, const Eigen::VectorXd& p,
                    SimulatedRobot* robot) {
    const int j = site.joint;
    const double coulomb = p[0], displacement = p[1];
    robot->joint_laws.push_back(
        {j, Eigen::VectorXd::Zero(1), true,
         [=](const ArmInstant& at, const double* z, double* rate) {
           const double v = at.velocity[j];
           rate[0] = (v - std::abs(v) * z[0]) / displacement;
           return -coulomb * z[0];
         }});
  };
  effect.near_zero = true;
  effect.stand_ins = {JointTerm::kViscous, JointTerm::kCoulomb};
  effect.means = {"coulomb_friction"};
  effect.set_drive = [](const EffectNumbers& numbers, JointDrive* drive) {
    const double coulomb = NumberOf(numbers, "coulomb");
    if (coulomb <= 0) return false;
    drive->bristles.push_back(
        {coulomb / NumberOf(numbers, "displacement"), coulomb, coulomb});
    return true;
  };
  effect.numbers = [](const EffectSite&, const Eigen::VectorXd& p) {
    return EffectNumbers{{"coulomb", p[0]}, {"displacement", p[1]}};
  };
  effect.experiment = "small motions to and fro, from 0.01 to 10 degrees";
  return effect;
}

}  // namespace effects
}  // namespace armcal

#include <cmath>

#include "model/dynamics/flanked_spring.h"
#include "model/effects/effect_parts.h"

namespace armcal {
inline namespace effects {

namespace {

// tau = deflection / compliance + damping rate: of the link's mode with the
// motor held, whose inertia is that of all beyond the joint.
double Damping(const EffectSite& site, const Eigen::VectorXd& p) {
  return 2 * p[1] * std::sqrt(CarriedInertia(site) / p[0]);
}

// 1/rad^2 or 1/m^2: p[2] is its share of the stiffness where the spring is
// wound up by the joint's usual torque.
double Stiffening(const EffectSite& site, const Eigen::VectorXd& p) {
  const double windup = p[0] * TorqueScale(site);
  return p[2] / (windup * windup);
}

}  // namespace

// Motor and link on a spring and a damper (Spong 1987): the link lags its motor
// by compliance times the load, and rings. `damping_ratio` is of the mode with
// the motor held. Gears stiffen as they wind up (harmonic drives: Tuttle and
// Seering 1996), so that large oscillations are faster than small ones. A
// simulation needs an armature of the joint.
Effect Elasticity() {
  Effect effect;
  effect.name = "elasticity";
  effect.nature = Effect::Nature::kLaw;
  effect.law = "tau = ID(q - compliance load) - ID(q)";
  effect.shows = "fast motion and reversals";
  effect.parameters = {
      Linear(
          "compliance", "P/E",
          [](const EffectSite& site) {
            return 3e-4 * Radian(site) / TorqueScale(site);
          },
          EffectParameter::Sign::kPositive),
      Gridded("damping_ratio", "1",
              [](const EffectSite&) {
                return std::vector<double>{.005, .02, .07, .25};
              }),
      Refined("stiffening", "1", {0, .01, .05, 1})};
  effect.larger_sizes = GeometricGrid(1.25, 160, 23);
  effect.apply = [](const EffectSite& site, const Eigen::VectorXd& p,
                    SimulatedRobot* robot) {
    if (p[0] <= 0) return;
    const double compliance = p[0];
    Transmission law;
    law.joint = site.joint;
    law.torque =
        FlankedSpring{0, 1 / compliance, Damping(site, p), Stiffening(site, p)};
    law.initial_deflection = [=](double load) { return compliance * load; };
    robot->transmissions.push_back(law);
  };
  effect.estimates = [](const EffectSite& site, const Eigen::VectorXd& p) {
    return std::vector<EffectEstimate>{
        {"stiffness", UnitAt(site, "E/P"), 1 / p[0]},
        {"damping", UnitAt(site, "E s/P"), Damping(site, p)},
        {"stiffening", UnitAt(site, "1/P^2"), Stiffening(site, p)}};
  };
  effect.set_drive = [](const EffectNumbers& numbers, JointDrive* drive) {
    if (drive->gear) return false;
    drive->gear = {0, NumberOf(numbers, "stiffness"),
                   NumberOf(numbers, "damping"),
                   NumberOf(numbers, "stiffening")};
    return true;
  };
  effect.proportional = false;
  effect.means = {"armature"};
  effect.numbers = [](const EffectSite& site, const Eigen::VectorXd& p) {
    return EffectNumbers{{"stiffness", 1 / p[0]},
                         {"damping", Damping(site, p)},
                         {"stiffening", Stiffening(site, p)}};
  };
  effect.experiment = "fast motion and stops; an encoder at the link";
  return effect;
}

}  // namespace effects
}  // namespace armcal

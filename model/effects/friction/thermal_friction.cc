#include <cmath>

#include "model/effects/effect_parts.h"

namespace armcal {
inline namespace effects {

namespace {

// Without a thermometer only beta times the rise is known: rises are those of
// joints that their usual friction warms by this.
constexpr double kUsualRise = 20;  // K

// W, of the cold joint at its usual speed.
double UsualPower(const EffectSite& site) {
  const double v = SpeedScale(site);
  return (site.at().viscous * v + site.at().coulomb) * v;
}

// As the thermometer says, else as `time_constant` does, s; p as below.
JointThermal Thermal(const EffectSite& site, const Eigen::VectorXd& p) {
  if (!site.scale->thermal.empty()) return site.scale->thermal[site.joint];
  const double resistance = kUsualRise / UsualPower(site);
  return {p[2] / resistance, resistance, p[0], p[1]};
}

std::vector<double> TimeConstants(const EffectSite& site) {
  if (!site.scale->thermal.empty()) {
    const JointThermal& thermal = site.scale->thermal[site.joint];
    return {thermal.capacity * thermal.resistance};
  }
  return GeometricGrid(.1 * Duration(site), 3 * Duration(site), 4);
}

std::string WhyNoFriction(const EffectSite& site) {
  return site.at().viscous > 0 || site.at().coulomb > 0
             ? ""
             : "the joint has no friction that warmth could change";
}

}  // namespace

// On the joint, viscous v (1 - exp(-beta warmth))
//   + coulomb tanh(v / w) (1 - exp(-coulomb_beta warmth)):
// friction that falls as the joint warms up (Bittencourt et al. 2010; Simoni et
// al. 2017), as the viscosity of oil does in Reynolds' law (1886). Warmth
// follows the power of what friction is left within time_constant, unless it
// was recorded.
Effect ThermalFriction() {
  Effect effect;
  effect.name = "thermal_friction";
  effect.nature = Effect::Nature::kDay;
  effect.law =
      "tau = -viscous v (1 - exp(-beta warmth)) - coulomb sign(v) (1 - "
      "exp(-coulomb_beta warmth))";
  effect.shows = "minutes of motion from cold";
  const auto size = [](const EffectSite&) { return .005; };
  effect.parameters = {
      Linear("beta", "1/K", size, EffectParameter::Sign::kPositive),
      Linear("coulomb_beta", "1/K", size, EffectParameter::Sign::kPositive),
      Gridded("time_constant", "s", TimeConstants)};
  effect.apply = [](const EffectSite& site, const Eigen::VectorXd& p,
                    SimulatedRobot* robot) {
    const int j = site.joint;
    const double viscous = site.at().viscous, coulomb = site.at().coulomb;
    const double beta = p[0], coulomb_beta = p[1];
    const double w = site.scale->width[j];
    robot->thermal.resize(robot->robot.num_joints());
    robot->thermal[j] = Thermal(site, p);
    AddFriction(
        site,
        [=](const ArmInstant& at) {
          const double v = at.velocity[j], warmth = at.temperature[j];
          return -viscous * v * std::expm1(-beta * warmth) -
                 coulomb * std::tanh(v / w) *
                     std::expm1(-coulomb_beta * warmth);
        },
        robot);
  };
  effect.proportional = false;
  effect.unfit = WhyNoFriction;
  effect.means = {"viscous_friction", "coulomb_friction"};
  effect.stand_ins = {JointTerm::kViscous, JointTerm::kCoulomb};
  effect.numbers = [](const EffectSite& site, const Eigen::VectorXd& p) {
    const JointThermal thermal = Thermal(site, p);
    return EffectNumbers{{"cold_viscous", site.at().viscous},
                         {"cold_coulomb", site.at().coulomb},
                         {"beta", p[0]},
                         {"coulomb_beta", p[1]},
                         {"width", site.scale->width[site.joint]},
                         {"capacity", thermal.capacity},
                         {"resistance", thermal.resistance}};
  };
  effect.experiment = "the same motion again and again from cold";
  return effect;
}

}  // namespace effects
}  // namespace armcal

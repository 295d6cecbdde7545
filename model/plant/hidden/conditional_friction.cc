#include "model/plant/hidden/conditional_friction.h"

#include <algorithm>
#include <cmath>

#include "model/plant/hidden/neighbour_joint.h"
#include "model/plant/hidden/zero_velocity.h"

namespace armcal {

namespace {

using Draw = EffectParameter::Draw;
using Scope = HiddenEffect::Scope;

// ln of what a lubricant's viscosity is multiplied by where it is dT kelvin
// warmer than 25 deg C, by Vogel's law (1921), of which beta is the slope
// there.
double VogelExponent(double beta, double dT) {
  constexpr double kVogel = 120;  // K, from 25 deg C down to the pole
  return -beta * dT * kVogel / (kVogel + dT);
}

// tau = -mu (sqrt(load^2 + P^2) - P) sign(v): teeth preloaded by P, 0.2 of the
// joint's torque scale, feel small loads little.
HiddenEffect LoadFriction() {
  return {"load_friction",
          true,
          Scope::kJoint,
          "Gear teeth pressed together by the load: friction that grows with "
          "the torque that the joint carries.",
          {{"coefficient", "1", .05, .005, .2, Draw::kLog, 5e-4, .8}},
          [](const EffectSite& site) -> std::vector<EffectValue> {
            const double mu = site.p[0], P = .2 * site.torque();
            const double w = site.width();
            const int k = site.from_tip();
            site.AddFriction([=](const ArmInstant& at, const double*, double*) {
              const double load = std::hypot(FromTip(at.load, k), P) - P;
              return -mu * load * ZeroVelocitySign(FromTip(at.velocity, k), w);
            });
            return {{"load_friction", "1", mu}};
          },
          nullptr};
}

// tau = -F exp(cos(n q - f) - 1) sign(v): tight spots, n per turn.
HiddenEffect PositionFriction() {
  return {"position_friction",
          true,
          Scope::kJoint,
          "A bent shaft or worn teeth: friction that is larger at some "
          "positions than at others.",
          {{"friction", "1", .1, .01, .3, Draw::kLog, 1e-3, 1.5},
           {"harmonic", "1", 1, 1, 4, Draw::kUniform},
           {"phase", "rad", 1, 0, 2 * M_PI, Draw::kUniform}},
          [](const EffectSite& site) -> std::vector<EffectValue> {
            const double F = site.p[0] * site.torque(), w = site.width();
            const double n = std::floor(site.p[1]) / site.radian();
            const double phase = site.p[2];
            const int k = site.from_tip();
            site.AddFriction([=](const ArmInstant& at, const double*, double*) {
              const double q = FromTip(at.position, k);
              return -F * std::exp(std::cos(n * q - phase) - 1) *
                     ZeroVelocitySign(FromTip(at.velocity, k), w);
            });
            return {{"friction", site.effort_unit(), F},
                    {"harmonic", "1/" + site.position_unit(), n},
                    {"phase", "rad", phase}};
          },
          nullptr};
}

// A bearing between two motors' shafts turns with u = v / S + r v' / S' (S the
// joints' speeds): tau = -G asinh(u / u0) / asinh(1 / u0), u0 = 0.3, on this
// joint and its share r S / S' of that on the neighbour, so that no motion
// gains energy.
HiddenEffect CoupledFriction() {
  return {"coupled_friction",
          true,
          Scope::kJoint,
          "A hollow shaft that turns in another, as in wrists: friction here "
          "that depends on the neighbour's velocity as well.",
          {{"friction", "1", .1, .01, .3, Draw::kLog, 1e-3, 1.5},
           {"ratio", "1", .7, .3, 1, Draw::kLogEitherSign, .1, 3}},
          [](const EffectSite& site) -> std::vector<EffectValue> {
            const EffectSite other = NeighbourJoint(site);
            const double S = site.speed(), S2 = other.speed(), r = site.p[1];
            // The weaker of the two bears it.
            const double power =
                std::min(site.torque() * S, other.torque() * S2);
            const double G = site.p[0] * power / S;
            const int k = site.from_tip(), k2 = other.from_tip();
            const auto torque = [=](const ArmInstant& at) {
              const double u = FromTip(at.velocity, k) / S +
                               r * FromTip(at.velocity, k2) / S2;
              return -G * std::asinh(u / .3) / std::asinh(1 / .3);
            };
            site.AddFriction([=](const ArmInstant& at, const double*, double*) {
              return torque(at);
            });
            other.AddFriction([=](const ArmInstant& at, const double*,
                                  double*) { return r * S / S2 * torque(at); });
            return {{"friction", site.effort_unit(), G},
                    {"ratio", "1", r * S / S2},
                    {"neighbour", "1", other.joint + 1.}};
          },
          WhyNoNeighbour};
}

// The joint's viscous friction times exp(-x) and its Coulomb friction times
// exp(-x / 3), a torque with the motion that takes from the ordinary friction
// what warmth took. x = beta dT C / (C + dT) by Vogel's law of viscosity
// (1921), exp(b / (T + 95 deg C)) for mineral oils (Crouch and Cameron 1961),
// of which beta is the slope at 25 deg C: C = 120 K. The joint's heat capacity
// is such that it warms by `rise` at its usual speed.
HiddenEffect ThermalFriction() {
  return {
      "thermal_friction",
      true,
      Scope::kJoint,
      "Oil that thins as the joint warms up with its own friction: the "
      "joint's friction falls over minutes of motion.",
      {{"beta", "1/K", .025, .01, .05, Draw::kLog, .002, .2},
       {"rise", "K", 20, 8, 30, Draw::kUniform, 1, 100},
       {"time_constant", "1", .5, .2, 2, Draw::kLog, .02, 20}},
      [](const EffectSite& site) -> std::vector<EffectValue> {
        const Joint& joint = site.link().joint;
        const double viscous = joint.viscous, coulomb = joint.coulomb;
        const double beta = site.p[0], S = site.speed(), w = site.width();
        const double power = (viscous * S + coulomb) * S;
        const double time_constant = site.p[2] * site.context->time_scale;
        site.robot->thermal.resize(site.robot->robot.num_joints());
        site.robot->thermal[site.index()] = {time_constant * power / site.p[1],
                                             site.p[1] / power};
        const int k = site.from_tip();
        site.AddFriction([=](const ArmInstant& at, const double*, double*) {
          const double v = FromTip(at.velocity, k);
          const double dT = FromTip(at.temperature, k);
          const double warm = VogelExponent(beta, dT);
          return -viscous * v * std::expm1(warm) -
                 coulomb * ZeroVelocitySign(v, w) * std::expm1(warm / 3);
        });
        return {{"beta", "1/K", beta}, {"time_constant", "s", time_constant}};
      },
      [](const SimulatedRobot& robot, int joint) -> std::string {
        const Joint& of = robot.robot.links[robot.num_passive + joint].joint;
        return of.viscous > 0 || of.coulomb > 0
                   ? ""
                   : "the joint has no friction that warmth could change";
      }};
}

// Grease that is `warmer` kelvin warmer in all joints, each by a share of that
// between .9 and 1.1. Its viscosity goes by Vogel's law as in ThermalFriction,
// exp(-x), x = beta dT C / (C + dT); sheared fast it is thinner (Cross 1965):
// tau = -viscous (exp(-x) - 1) v / (1 + |v| / (20 S)), beside the friction that
// joints have.
HiddenEffect ViscousFrictionOfAllJoints() {
  return {
      "viscous_friction_of_all_joints",
      true,
      Scope::kRobot,
      "Grease that is warmer or colder than when the friction was measured: "
      "viscous friction of all joints by one share.",
      {{"warmer", "K", 5, 1, 15, Draw::kLogEitherSign, .05, 40},
       {"beta", "1/K", .025, .015, .035, Draw::kUniform, .002, .2}},
      [](const EffectSite& site) -> std::vector<EffectValue> {
        const auto change = [&](double dT) {
          return std::expm1(VogelExponent(site.p[1], dT));
        };
        std::mt19937_64 random =
            site.RandomInTime("viscous_friction_of_all_joints");
        std::uniform_real_distribution<double> share(.9, 1.1);
        double sum = 0;
        for (int j = 0; j < site.num_driven(); ++j) {
          EffectSite at = site;
          at.joint = j;
          const double viscous = at.link().joint.viscous;
          const double of_joint = change(share(random) * site.p[0]);
          sum += of_joint;
          const double more = viscous * of_joint;
          const double S = at.speed();
          const int k = at.from_tip();
          at.AddFriction(
              [=](const ArmInstant& instant, const double*, double*) {
                const double v = FromTip(instant.velocity, k);
                return -more * v / (1 + std::abs(v) / (20 * S));
              });
        }
        return {{"share", "1", sum / site.num_driven()}};
      },
      [](const SimulatedRobot& robot, int) -> std::string {
        int viscous = 0;
        for (const Link& link : robot.robot.links) {
          viscous += link.joint.viscous > 0;
        }
        return viscous > 2 ? ""
                           : "fewer than three joints have viscous friction";
      }};
}

}  // namespace

std::vector<HiddenEffect> ConditionalFriction() {
  return {LoadFriction(), PositionFriction(), CoupledFriction(),
          ThermalFriction(), ViscousFrictionOfAllJoints()};
}

}  // namespace armcal

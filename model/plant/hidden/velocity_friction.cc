#include "model/plant/hidden/velocity_friction.h"

#include <cmath>

#include "model/plant/hidden/zero_velocity.h"

namespace armcal {

namespace {

using Draw = EffectParameter::Draw;
using Scope = HiddenEffect::Scope;

// tau = -c v0 asinh(v / v0), v0 ten times the joint's speed: Eyring's law of a
// thinning lubricant, 0.2 % below the line at that speed.
HiddenEffect Viscous() {
  return {"viscous_friction",
          true,
          Scope::kJoint,
          "A thicker lubricant: drag in proportion to the velocity.",
          {{"drag", "1", .1, .01, .5, Draw::kLog, 1e-3, 2.5}},
          [](const EffectSite& site) -> std::vector<EffectValue> {
            const double c = site.p[0] * site.torque() / site.speed();
            const double v0 = 10 * site.speed();
            const int k = site.from_tip();
            site.AddFriction([=](const ArmInstant& at, const double*, double*) {
              return -c * v0 * std::asinh(FromTip(at.velocity, k) / v0);
            });
            return {{"viscous",
                     site.effort_unit() + " s/" + site.position_unit(), c}};
          },
          nullptr};
}

// tau = -F v / sqrt(v^2 + w^2).
HiddenEffect Coulomb() {
  return {"coulomb_friction",
          true,
          Scope::kJoint,
          "A tighter bearing: a constant torque against the motion.",
          {{"friction", "1", .1, .01, .3, Draw::kLog, 1e-3, 1.5}},
          [](const EffectSite& site) -> std::vector<EffectValue> {
            const double F = site.p[0] * site.torque(), w = site.width();
            const int k = site.from_tip();
            site.AddFriction([=](const ArmInstant& at, const double*, double*) {
              return -F * ZeroVelocitySign(FromTip(at.velocity, k), w);
            });
            return {{"coulomb", site.effort_unit(), F}};
          },
          nullptr};
}

// tau = -|a| e (1 + sgn(a) v / sqrt(v^2 + w^2)), e = v0 asinh(v / v0), v0 three
// times the joint's speed: drag of a thinning lubricant, 2 |a| one way only;
// about |a| v of it is viscous friction and a |v| asymmetry.
HiddenEffect Asymmetric() {
  return {"asymmetric_friction",
          true,
          Scope::kJoint,
          "A lip seal that drags in one direction: extra drag while the joint "
          "moves one way, none the other.",
          {{"asymmetry", "1", .05, .005, .2, Draw::kLogEitherSign, 5e-4, 1}},
          [](const EffectSite& site) -> std::vector<EffectValue> {
            const double a = site.p[0] * site.torque() / site.speed();
            const double v0 = 3 * site.speed(), w = site.width();
            const int k = site.from_tip();
            site.AddFriction([=](const ArmInstant& at, const double*, double*) {
              const double v = FromTip(at.velocity, k);
              return -(std::abs(a) + a * ZeroVelocitySign(v, w)) * v0 *
                     std::asinh(v / v0);
            });
            const std::string unit =
                site.effort_unit() + " s/" + site.position_unit();
            return {{"asymmetric", unit, a}, {"viscous", unit, std::abs(a)}};
          },
          nullptr};
}

// tau = -T v/S (|v|/S)^0.75: turbulent churning (Blasius' exponent 1.75).
HiddenEffect Quadratic() {
  return {"quadratic_friction",
          true,
          Scope::kJoint,
          "Oil that churns: drag that grows faster than the velocity.",
          {{"drag", "1", .05, .005, .2, Draw::kLog, 5e-4, 1}},
          [](const EffectSite& site) -> std::vector<EffectValue> {
            const double T = site.p[0] * site.torque(), S = site.speed();
            const double w = site.width();
            const int k = site.from_tip();
            site.AddFriction([=](const ArmInstant& at, const double*, double*) {
              const double v = FromTip(at.velocity, k);
              return -T * v / S * std::pow(std::hypot(v, w) / S, .75);
            });
            // That of v |v| with the same torque at the joint's speed.
            return {{"quadratic",
                     site.effort_unit() + " s^2/" + site.position_unit() + "^2",
                     T / (S * S)}};
          },
          nullptr};
}

// tau = -F sign(v) / (1 + (v / vs)^2), Hess and Soom 1990.
HiddenEffect Stribeck() {
  return {"stribeck",
          true,
          Scope::kJoint,
          "Boundary lubrication: more friction near standstill, which a film "
          "of oil relieves as the joint speeds up.",
          {{"friction", "1", .05, .005, .2, Draw::kLog, 5e-4, 1},
           {"velocity", "1", .1, .04, .3, Draw::kLog, .02, 1.5}},
          [](const EffectSite& site) -> std::vector<EffectValue> {
            const double F = site.p[0] * site.torque();
            const double vs = site.p[1] * site.speed(), w = site.width();
            const int k = site.from_tip();
            site.AddFriction([=](const ArmInstant& at, const double*, double*) {
              const double v = FromTip(at.velocity, k);
              return -F * ZeroVelocitySign(v, w) / (1 + v * v / (vs * vs));
            });
            return {{"stribeck", site.effort_unit(), F},
                    {"stribeck_velocity", site.position_unit() + "/s", vs}};
          },
          nullptr};
}

}  // namespace

std::vector<HiddenEffect> VelocityFriction() {
  return {Viscous(), Coulomb(), Asymmetric(), Quadratic(), Stribeck()};
}

}  // namespace armcal

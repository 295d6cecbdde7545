#include "model/plant/hidden/friction_memory.h"

#include <cmath>

#include "model/plant/hidden/random_signal.h"
#include "model/plant/hidden/zero_velocity.h"

namespace armcal {

namespace {

using Draw = EffectParameter::Draw;
using Scope = HiddenEffect::Scope;

// Bristles that bend by b' = v d |d|, d = 1 - sign(v) b / z, and give
// F b / z + c b': from rest F x / (x + z), Dahl's law with the exponent 2, and
// LuGre's damping c = 0.1 F / S (S the joint's speed). Time constant in motion
// above z / 4 |v|: 0.2 ms for 2 mrad at 3 rad/s.
HiddenEffect Presliding() {
  return {"presliding",
          true,
          Scope::kJoint,
          "Bristles that bend before they slip: friction that holds like a "
          "spring at standstill and builds up over a displacement after a "
          "reversal.",
          {{"friction", "1", .1, .02, .3, Draw::kLog, 1e-3, 1.5},
           {"displacement", "1", .01, .002, .03, Draw::kLog, .002, .15}},
          [](const EffectSite& site) -> std::vector<EffectValue> {
            const double F = site.p[0] * site.torque();
            const double z = site.p[1] * site.radian();
            const double c = .1 * F / site.speed(), w = site.width();
            const int k = site.from_tip();
            site.AddFriction(
                [=](const ArmInstant& at, const double* b, double* rate) {
                  const double v = FromTip(at.velocity, k);
                  const double d = 1 - ZeroVelocitySign(v, w) * b[0] / z;
                  rate[0] = v * d * std::abs(d);
                  return -F * b[0] / z - c * rate[0];
                },
                Eigen::VectorXd::Zero(1));
            return {{"coulomb", site.effort_unit(), F},
                    {"displacement", site.position_unit(), z}};
          },
          nullptr};
}

// tau = -F s (1 - s m) / 2, s = sign(v), m' = |v| (s - m) / L: after a
// reversal the friction is F and falls to nothing over the distance L.
HiddenEffect ApproachFriction() {
  return {"approach_friction",
          false,
          Scope::kJoint,
          "A seal that rolls over: friction that is large after each reversal "
          "and fades with the distance from it.",
          {{"friction", "1", .1, .02, .3, Draw::kLog, 1e-3, 1.5},
           {"distance", "1", .2, .05, .5, Draw::kLog, .02, 2.5}},
          [](const EffectSite& site) -> std::vector<EffectValue> {
            const double F = site.p[0] * site.torque(), w = site.width();
            const double L = site.p[1] * site.radian();
            const int k = site.from_tip();
            site.AddFriction(
                [=](const ArmInstant& at, const double* m, double* rate) {
                  const double v = FromTip(at.velocity, k);
                  const double s = ZeroVelocitySign(v, w);
                  rate[0] = v * s * (s - m[0]) / L;
                  return -F * s * (1 - s * m[0]) / 2;
                },
                Eigen::VectorXd::Zero(1));
            return {{"friction", site.effort_unit(), F},
                    {"distance", site.position_unit(), L}};
          },
          nullptr};
}

HiddenEffect DraggingBrake() {
  return {
      "dragging_brake",
      false,
      Scope::kJoint,
      "A brake that does not always release: extra friction during some "
      "spans of time.",
      {{"friction", "1", .1, .02, .3, Draw::kLog, 1e-3, 1.5},
       {"share", "1", .2, .05, .3, Draw::kLog, .005, .48}},
      [](const EffectSite& site) -> std::vector<EffectValue> {
        constexpr int kSpans = 4;
        const double F = site.p[0] * site.torque(), w = site.width();
        const double D = site.context->duration;
        std::mt19937_64 random = site.RandomInTime("dragging_brake");
        const RandomSpans spans(kSpans, site.p[1] * D / kSpans, D, &random);
        const int k = site.from_tip();
        site.AddFriction([=](const ArmInstant& at, const double*, double*) {
          return -F * spans(at.t) *
                 ZeroVelocitySign(FromTip(at.velocity, k), w);
        });
        return {{"friction", site.effort_unit(), F}, {"share", "1", site.p[1]}};
      },
      nullptr};
}

}  // namespace

std::vector<HiddenEffect> FrictionMemory() {
  return {Presliding(), ApproachFriction(), DraggingBrake()};
}

}  // namespace armcal

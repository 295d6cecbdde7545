#include "model/plant/hidden/sensor_effects.h"

#include <cmath>

#include "model/plant/hidden/random_signal.h"

namespace armcal {

namespace {

using Draw = EffectParameter::Draw;
using Scope = HiddenEffect::Scope;

HiddenEffect EncoderOffset() {
  return {"encoder_offset",
          true,
          Scope::kJoint,
          "A wrong zero of the encoder: positions in the log are off by a "
          "constant, and gravity does not fit them.",
          {{"offset", "1", .01, .002, .05, Draw::kLogEitherSign, 2e-4, .5}},
          [](const EffectSite& site) -> std::vector<EffectValue> {
            const double b = site.p[0] * site.radian();
            const int k = site.from_tip();
            site.robot->sensors.push_back(
                {[=](const ArmInstant&, Reading* reading) {
                  FromTip(&reading->position, k) += b;
                }});
            return {{"offset", site.position_unit(), b}};
          },
          nullptr};
}

HiddenEffect WanderingEncoder() {
  return {"wandering_encoder",
          false,
          Scope::kJoint,
          "An encoder that is loose on its shaft: positions wander slowly.",
          {{"wander", "1", .002, 3e-4, .005, Draw::kLog, 3e-5, .025}},
          [](const EffectSite& site) -> std::vector<EffectValue> {
            const double A = site.p[0] * site.radian();
            std::mt19937_64 random = site.RandomInTime("wandering_encoder");
            const RandomSignal wander(.03, .5, &random);
            const int k = site.from_tip();
            site.robot->sensors.push_back(
                {[=](const ArmInstant& at, Reading* reading) {
                  FromTip(&reading->position, k) += A * wander(at.t);
                }});
            return {{"wander_rms", site.position_unit(), A}};
          },
          nullptr};
}

// reading = q + e (sin(q + f) - sin f).
HiddenEffect EncoderEccentricity() {
  return {"encoder_eccentricity",
          false,
          Scope::kJoint,
          "An encoder disc off its axis: positions err by one wave per turn.",
          {{"eccentricity", "1", .003, 1e-3, .02, Draw::kLog, 1e-4, .1},
           {"phase", "rad", 1, 0, 2 * M_PI, Draw::kUniform}},
          [](const EffectSite& site) -> std::vector<EffectValue> {
            const double e = site.p[0] * site.radian(), f = site.p[1];
            const double radian = site.radian();
            const int k = site.from_tip();
            site.robot->sensors.push_back(
                {[=](const ArmInstant&, Reading* reading) {
                  double& q = FromTip(&reading->position, k);
                  q += e * (std::sin(q / radian + f) - std::sin(f));
                }});
            return {{"eccentricity", site.position_unit(), e}};
          },
          nullptr};
}

// reading = v (1 - g (1 - exp(-2 t / D))), D the time scale.
HiddenEffect AgingTachometer() {
  return {"aging_tachometer",
          false,
          Scope::kJoint,
          "A tachometer whose magnet ages: logged velocities shrink with "
          "time, positions do not.",
          {{"loss", "1", .1, .02, .3, Draw::kLog, 2e-3, .8}},
          [](const EffectSite& site) -> std::vector<EffectValue> {
            const double g = site.p[0], D = site.context->time_scale;
            const int k = site.from_tip();
            site.robot->sensors.push_back(
                {[=](const ArmInstant& at, Reading* reading) {
                  FromTip(&reading->velocity, k) *=
                      1 + g * std::expm1(-2 * at.t / D);
                }});
            return {{"loss", "1", g}};
          },
          nullptr};
}

// stamp = t + r (t + 0.3 sin(w t) / w), a wave of 15 s: a clock whose rate is
// off by the share r on average and by 0.7 to 1.3 r at a time.
HiddenEffect TimeBase() {
  return {"time_base",
          true,
          Scope::kRobot,
          "A clock that runs fast or slow: all velocities and accelerations "
          "come out wrong by its rate.",
          {{"rate", "1", .002, 2e-4, .01, Draw::kLogEitherSign, 2e-5, .05}},
          [](const EffectSite& site) -> std::vector<EffectValue> {
            const double r = site.p[0], w = 2 * M_PI / 15;
            site.robot->clock = [=](double t) {
              return t + r * (t + .3 * std::sin(w * t) / w);
            };
            return {{"rate", "1", r}};
          },
          nullptr};
}

}  // namespace

std::vector<HiddenEffect> SensorEffects() {
  return {EncoderOffset(), TimeBase(), WanderingEncoder(),
          EncoderEccentricity(), AgingTachometer()};
}

}  // namespace armcal

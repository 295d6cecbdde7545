#include "model/plant/hidden/time_torques.h"

#include <cmath>

#include "model/plant/hidden/random_signal.h"

namespace armcal {

namespace {

using Draw = EffectParameter::Draw;
using Scope = HiddenEffect::Scope;

// tau = -A 2 t / (t + D), D the time scale: fast at first, A at D, never 2 A.
HiddenEffect TimeDrift() {
  return {"time_drift",
          true,
          Scope::kJoint,
          "A bias that settles: a torque that grows from zero, fast at first.",
          {{"torque", "1", .05, .005, .2, Draw::kLogEitherSign, 5e-4, 1}},
          [](const EffectSite& site) -> std::vector<EffectValue> {
            const double A = site.p[0] * site.torque();
            const double D = site.context->time_scale;
            site.AddTorque([=](const ArmInstant& at, const double*, double*) {
              return -A * 2 * at.t / (at.t + D);
            });
            return {{"drift", site.effort_unit(), A},
                    {"drift_rate", site.effort_unit() + "/s", A / D}};
          },
          nullptr};
}

// tau = A sin(2 pi f t + 0.3 wander(t)): a shaker whose speed is not constant.
HiddenEffect Vibration() {
  return {"vibration",
          true,
          Scope::kJoint,
          "A fan or a press nearby: a torque at one frequency whatever the arm "
          "does.",
          {{"amplitude", "1", .03, .005, .1, Draw::kLog, 5e-4, .5},
           {"frequency", "Hz", 8, 3, 30, Draw::kLog, .5, 100}},
          [](const EffectSite& site) -> std::vector<EffectValue> {
            const double A = site.p[0] * site.torque();
            const double omega = 2 * M_PI * site.p[1];
            std::mt19937_64 random = site.RandomInTime("vibration");
            const double phase = DrawUniform(0, 2 * M_PI, &random);
            const RandomSignal wander(.02, .2, &random);
            site.AddTorque([=](const ArmInstant& at, const double*, double*) {
              return A * std::sin(omega * at.t + phase + .3 * wander(at.t));
            });
            return {{"amplitude", site.effort_unit(), A},
                    {"frequency", "Hz", site.p[1]}};
          },
          nullptr};
}

HiddenEffect RandomTorque() {
  return {"random_torque",
          false,
          Scope::kJoint,
          "A torque that wanders at random between 0.05 and 5 Hz.",
          {{"torque", "1", .05, .01, .2, Draw::kLog, 1e-3, 1}},
          [](const EffectSite& site) -> std::vector<EffectValue> {
            const double A = site.p[0] * site.torque();
            std::mt19937_64 random = site.RandomInTime("random_torque");
            const RandomSignal signal(.05, 5, &random);
            site.AddTorque([=](const ArmInstant& at, const double*, double*) {
              return A * signal(at.t);
            });
            return {{"torque_rms", site.effort_unit(), A}};
          },
          nullptr};
}

}  // namespace

std::vector<HiddenEffect> TimeTorques() {
  return {TimeDrift(), Vibration(), RandomTorque()};
}

}  // namespace armcal

#include "model/plant/hidden/position_torques.h"

#include <cmath>

namespace armcal {

namespace {

using Draw = EffectParameter::Draw;
using Scope = HiddenEffect::Scope;

// tau = -k X sinh((q - q0) / X), X = 2 rad: the coils of a torsion spring bind
// as it winds up; 4 % above the line at 1 rad.
HiddenEffect Spring() {
  return {"spring",
          true,
          Scope::kJoint,
          "A torsion spring, as of a balancer: a torque back to one position.",
          {{"stiffness", "1", .1, .01, .5, Draw::kLog, 1e-3, 2.5},
           {"neutral", "1", .2, -.5, .5, Draw::kUniform, -3, 3}},
          [](const EffectSite& site) -> std::vector<EffectValue> {
            const double k0 = site.p[0] * site.torque() / site.radian();
            const double q0 = site.p[1] * site.radian();
            const double X = 2 * site.radian();
            const int k = site.from_tip();
            site.AddTorque([=](const ArmInstant& at, const double*, double*) {
              return -k0 * X * std::sinh((FromTip(at.position, k) - q0) / X);
            });
            return {{"stiffness",
                     site.effort_unit() + "/" + site.position_unit(), k0},
                    {"neutral", site.position_unit(), q0}};
          },
          nullptr};
}

// tau = -A 2/pi atan((q - q0) / b): a bundle that lies over to one side or the
// other.
HiddenEffect Cable() {
  return {"cable",
          true,
          Scope::kJoint,
          "A cable bundle that bends over as the joint turns past it: a torque "
          "of the position that saturates to both sides.",
          {{"torque", "1", .05, .005, .2, Draw::kLog, 5e-4, 1},
           {"centre", "1", .1, -.5, .5, Draw::kUniform, -3, 3},
           {"softness", "1", .3, .1, .6, Draw::kLog, .02, 3}},
          [](const EffectSite& site) -> std::vector<EffectValue> {
            const double A = site.p[0] * site.torque();
            const double q0 = site.p[1] * site.radian();
            const double b = site.p[2] * site.radian();
            const int k = site.from_tip();
            site.AddTorque([=](const ArmInstant& at, const double*, double*) {
              return -A * 2 / M_PI *
                     std::atan((FromTip(at.position, k) - q0) / b);
            });
            return {{"cable", site.effort_unit(), A},
                    {"centre", site.position_unit(), q0},
                    {"softness", site.position_unit(), b}};
          },
          nullptr};
}

// tau = -A sin(f) / (1 - 0.3 cos(f)), f = n q + phase: a skewed wave with
// overtones (0.15 of the second harmonic) and a potential, as cogging has.
HiddenEffect TorqueRipple() {
  return {"torque_ripple",
          true,
          Scope::kJoint,
          "Cogging of the motor or mesh of the gear: a torque that comes back "
          "every 1/n of a turn.",
          {{"amplitude", "1", .02, .002, .1, Draw::kLog, 2e-4, .5},
           {"harmonic", "1", 20, 6, 60, Draw::kLog, 1, 300},
           {"phase", "rad", 1, 0, 2 * M_PI, Draw::kUniform}},
          [](const EffectSite& site) -> std::vector<EffectValue> {
            const double A = site.p[0] * site.torque();
            // Whole waves per turn, as teeth and poles have.
            const double n = std::round(site.p[1]) / site.radian();
            const double phase = site.p[2];
            const int k = site.from_tip();
            site.AddTorque([=](const ArmInstant& at, const double*, double*) {
              const double f = n * FromTip(at.position, k) + phase;
              return -A * std::sin(f) / (1 - .3 * std::cos(f));
            });
            return {{"ripple", site.effort_unit(), A},
                    {"harmonic", "1/" + site.position_unit(), n},
                    {"phase", "rad", phase}};
          },
          nullptr};
}

}  // namespace

std::vector<HiddenEffect> PositionTorques() {
  return {Spring(), Cable(), TorqueRipple()};
}

}  // namespace armcal

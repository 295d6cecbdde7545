#include "model/plant/hidden/amplifier_effects.h"

#include <cmath>

namespace armcal {

namespace {

using Draw = EffectParameter::Draw;
using Scope = HiddenEffect::Scope;

// A map of this joint's torque alone.
template <typename Map>
void AddMap(const EffectSite& site, const Map& map) {
  const int k = site.from_tip();
  site.robot->actuators.push_back(
      {{},
       [=](const ArmInstant&, const double*, double*, Eigen::VectorXd* torque) {
         double& tau = FromTip(torque, k);
         tau = map(tau);
       }});
}

// given = commanded - b: the amplifier's zero is off.
HiddenEffect TorqueOffset() {
  return {"torque_offset",
          true,
          Scope::kJoint,
          "An amplifier whose zero is off: the log holds a constant torque "
          "that the motor never gave.",
          {{"offset", "1", .05, .005, .2, Draw::kLogEitherSign, 5e-4, 1}},
          [](const EffectSite& site) -> std::vector<EffectValue> {
            const double b = site.p[0] * site.torque();
            AddMap(site, [=](double tau) { return tau - b; });
            return {{"offset", site.effort_unit(), b}};
          },
          nullptr};
}

// given = commanded / (1 + g).
HiddenEffect TorqueGain() {
  return {"torque_gain",
          true,
          Scope::kJoint,
          "A motor constant other than assumed: logged torques are (1 + gain) "
          "of what the motor gave.",
          {{"gain", "1", .05, .01, .2, Draw::kLogEitherSign, 1e-3, .88}},
          [](const EffectSite& site) -> std::vector<EffectValue> {
            const double g = site.p[0];
            AddMap(site, [=](double tau) { return tau / (1 + g); });
            return {{"gain", "1", g}};
          },
          nullptr};
}

// given = commanded / (1 + g_j), the g_j of all joints within 2 % of 1 + gain.
HiddenEffect TorqueGainOfAllJoints() {
  return {
      "torque_gain_of_all_joints",
      true,
      Scope::kRobot,
      "Torques in another unit than assumed, as peak currents for rms ones: "
      "logged torques of all joints are (1 + gain) of what motors gave.",
      {{"gain", "1", .15, .05, .5, Draw::kLogEitherSign, 3e-3, .88}},
      [](const EffectSite& site) -> std::vector<EffectValue> {
        std::mt19937_64 random = site.Random("torque_gain_of_all_joints");
        std::uniform_real_distribution<double> share(.98, 1.02);
        for (int j = 0; j < site.num_driven(); ++j) {
          EffectSite at = site;
          at.joint = j;
          const double times = share(random) * (1 + site.p[0]);
          AddMap(at, [=](double tau) { return tau / times; });
        }
        return {{"gain", "1", site.p[0]}};
      },
      [](const SimulatedRobot& robot, int) -> std::string {
        return robot.robot.num_joints() - robot.num_passive > 2
                   ? ""
                   : "the robot has fewer than three motors";
      }};
}

// given = commanded (1 - 2 f x^2 / (1 + x^2)), x = commanded / 2 T: the motor
// constant has fallen by the share f at twice the joint's torque scale T.
HiddenEffect TorqueNonlinearity() {
  return {
      "torque_nonlinearity",
      true,
      Scope::kJoint,
      "Iron that saturates: the motor constant falls with the current.",
      {{"fall", "1", .05, .01, .2, Draw::kLog, 1e-3, .4}},
      [](const EffectSite& site) -> std::vector<EffectValue> {
        const double f = site.p[0], peak = 2 * site.torque();
        AddMap(site, [=](double tau) {
          const double x2 = (tau / peak) * (tau / peak);
          return tau * (1 - 2 * f * x2 / (1 + x2));
        });
        return {{"fall", "1", f}, {"fall_torque", site.effort_unit(), peak}};
      },
      nullptr};
}

// given = commanded / (1 + |commanded / L|^12)^(1/12): a soft knee, 6 % below
// the limit at it. L falls from that at the joint's speed scale S as the motor
// turns along its torque, as far as the supply's voltage lets it,
//   L(v) = L (1 - fall (v / S - 1)), at least a hundredth of L.
HiddenEffect TorqueSaturation() {
  return {
      "torque_saturation",
      true,
      Scope::kJoint,
      "A limit of current, or of voltage, which falls with speed: torques "
      "beyond it are commanded but not given.",
      {{"limit", "1", 1.6, 1.3, 2.5, Draw::kLog, .8, 13},
       {"fall", "1", 0, 0, 1, Draw::kUniform, 0, 3}},
      [](const EffectSite& site) -> std::vector<EffectValue> {
        const double L = site.p[0] * site.torque(), S = site.speed();
        const double fall = site.p[1];
        const int k = site.from_tip();
        site.robot->actuators.push_back(
            {{},
             [=](const ArmInstant& at, const double*, double*,
                 Eigen::VectorXd* torque) {
               double& tau = FromTip(torque, k);
               const double v = std::copysign(1, tau) * FromTip(at.velocity, k);
               const double most = L * std::max(.01, 1 - fall * (v / S - 1));
               tau /= std::pow(1 + std::pow(std::abs(tau / most), 12), 1. / 12);
             }});
        return {
            {"limit", site.effort_unit(), L * (1 + fall)},
            {"limit_slope", site.effort_unit() + " s/" + site.position_unit(),
             L * fall / S}};
      },
      nullptr};
}

// given = commanded (1 - d / sqrt(commanded^2 + d^2)): flat at zero, d short of
// the command far from it.
HiddenEffect TorqueDeadband() {
  return {"torque_deadband",
          true,
          Scope::kJoint,
          "An amplifier that ignores small commands: the motor gives less than "
          "asked by a constant, and nothing near zero.",
          {{"deadband", "1", .03, .005, .1, Draw::kLog, 5e-4, .5}},
          [](const EffectSite& site) -> std::vector<EffectValue> {
            const double d = site.p[0] * site.torque();
            AddMap(site, [=](double tau) {
              return tau * (1 - d / std::hypot(tau, d));
            });
            return {{"deadband", site.effort_unit(), d}};
          },
          nullptr};
}

}  // namespace

std::vector<HiddenEffect> AmplifierEffects() {
  return {TorqueOffset(),       TorqueGain(),       TorqueGainOfAllJoints(),
          TorqueNonlinearity(), TorqueSaturation(), TorqueDeadband()};
}

}  // namespace armcal

#include "model/plant/hidden/drive_dynamics.h"

#include "model/plant/hidden/neighbour_joint.h"

namespace armcal {

namespace {

using Draw = EffectParameter::Draw;
using Scope = HiddenEffect::Scope;
using Eigen::VectorXd;

// Two lags of half the delay T each per joint: 1 / (1 + s T / 2)^2, which is
// late by T at low frequency. Starts with no torque.
HiddenEffect Delay() {
  return {
      "delay",
      true,
      Scope::kRobot,
      "Current loops that take their time: the motors give what was asked "
      "for a little earlier.",
      {{"delay", "s", .004, .001, .01, Draw::kLog, 2e-4, .05}},
      [](const EffectSite& site) -> std::vector<EffectValue> {
        const double lag = site.p[0] / 2;
        const int n = site.num_driven();
        site.robot->actuators.push_back(
            {VectorXd::Zero(2 * n), [=](const ArmInstant&, const double* state,
                                        double* rate, VectorXd* torque) {
               for (int j = 0; j < n; ++j) {
                 double& tau = FromTip(torque, n - j);
                 rate[2 * j] = (tau - state[2 * j]) / lag;
                 rate[2 * j + 1] = (state[2 * j] - state[2 * j + 1]) / lag;
                 tau = state[2 * j + 1];
               }
             }});
        return {{"delay", "s", site.p[0]}};
      },
      nullptr};
}

// given = commanded - g c, c' = (neighbour's command - c) / 3 ms.
HiddenEffect TorqueCrosstalk() {
  return {"torque_crosstalk",
          true,
          Scope::kJoint,
          "A neighbour's current in this joint's current sensor: the logged "
          "torque holds a share of the neighbour's.",
          {{"gain", "1", .03, .005, .2, Draw::kLogEitherSign, 5e-4, 1}},
          [](const EffectSite& site) -> std::vector<EffectValue> {
            constexpr double kLag = .003;  // s
            const EffectSite other = NeighbourJoint(site);
            const double g = site.p[0] * site.torque() / other.torque();
            const int k = site.from_tip(), k2 = other.from_tip();
            site.robot->actuators.push_back(
                {VectorXd::Zero(1), [=](const ArmInstant&, const double* state,
                                        double* rate, VectorXd* torque) {
                   rate[0] = (FromTip(*torque, k2) - state[0]) / kLag;
                   FromTip(torque, k) -= g * state[0];
                 }});
            return {{"gain",
                     site.effort_unit() + "/(" + other.effort_unit() + ")", g},
                    {"neighbour", "1", other.joint + 1.}};
          },
          WhyNoNeighbour};
}

// All torques times 1 - s p / (p + P): p the motors' power, smoothed over
// 50 ms by the supply's capacitor, P what they take at the joints' scales.
HiddenEffect SupplySag() {
  return {
      "supply_sag",
      false,
      Scope::kRobot,
      "A weak supply: the torque of all joints falls while the arm as a "
      "whole takes power.",
      {{"sag", "1", .1, .02, .4, Draw::kLog, 2e-3, .9}},
      [](const EffectSite& site) -> std::vector<EffectValue> {
        constexpr double kSmoothing = .05;  // s
        const double sag = site.p[0];
        const int n = site.num_driven();
        const double P = site.context->torque.dot(site.context->speed);
        site.robot->actuators.push_back(
            {VectorXd::Zero(1), [=](const ArmInstant& at, const double* state,
                                    double* rate, VectorXd* torque) {
               const double power = torque->tail(n)
                                        .cwiseProduct(at.velocity.tail(n))
                                        .cwiseAbs()
                                        .sum();
               rate[0] = (power - state[0]) / kSmoothing;
               *torque *= 1 - sag * state[0] / (state[0] + P);
             }});
        return {{"sag", "1", sag}, {"power", "W", P}};
      },
      nullptr};
}

// given = commanded (1 - f h), h' = ((commanded / T)^2 - h) / (D / 4): magnets
// lose the share f at the joint's torque scale T, over a quarter of the
// time scale D.
HiddenEffect WarmingMotor() {
  return {"warming_motor",
          false,
          Scope::kJoint,
          "Magnets that weaken as the windings warm up: the same torque takes "
          "more and more current.",
          {{"loss", "1", .05, .01, .1, Draw::kLog, 1e-3, .2}},
          [](const EffectSite& site) -> std::vector<EffectValue> {
            const double f = site.p[0], T = site.torque();
            const double time_constant = site.context->time_scale / 4;
            const int k = site.from_tip();
            site.robot->actuators.push_back(
                {VectorXd::Zero(1), [=](const ArmInstant&, const double* state,
                                        double* rate, VectorXd* torque) {
                   double& tau = FromTip(torque, k);
                   rate[0] = (tau * tau / (T * T) - state[0]) / time_constant;
                   tau *= 1 - f * state[0];
                 }});
            return {{"loss", "1", f}, {"time_constant", "s", time_constant}};
          },
          nullptr};
}

}  // namespace

std::vector<HiddenEffect> DriveDynamics() {
  return {Delay(), TorqueCrosstalk(), SupplySag(), WarmingMotor()};
}

}  // namespace armcal

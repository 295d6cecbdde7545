#include "model/plant/hidden/transmission_effects.h"

#include <algorithm>
#include <cmath>

namespace armcal {

namespace {

using Draw = EffectParameter::Draw;
using Scope = HiddenEffect::Scope;

// A motor that yields against its link needs an inertia of its own: 0.3 of the
// joint's where the robot gives none.
double MotorInertia(const EffectSite& site) {
  double& armature = site.link().joint.armature;
  if (armature <= 0) armature = .3 * site.context->inertia[site.joint];
  return armature;
}

EffectValue MotorValue(const EffectSite& site) {
  return {"armature", IsRotational(site.type()) ? "kg m^2" : "kg",
          site.link().joint.armature};
}

std::string WhyTransmitted(const SimulatedRobot& robot, int joint) {
  for (const Transmission& transmission : robot.transmissions) {
    if (transmission.joint == robot.num_passive + joint) {
      return "the joint has a transmission that yields already";
    }
  }
  return "";
}

// What a gear transmits as it winds up: straight lines with the slopes K1 < K2
// < K3, of which the second begins at the torque T1 and the third at T2, as the
// makers of strain wave gears measure and publish it (Harmonic Drive SE,
// engineering data, "torsional stiffness"). Here K2 = 1.3 K1 and K3 = 1.5 K1,
// T1 at 0.3 of the joint's torque scale and T2 at the scale itself.
class WindUp {
 public:
  WindUp(double stiffness, double scale)
      : K_{stiffness, 1.3 * stiffness, 1.5 * stiffness},
        T_{0, .3 * scale, scale},
        d_{0, T_[1] / K_[0], T_[1] / K_[0] + (T_[2] - T_[1]) / K_[1]} {}

  double Torque(double d) const {
    const int k = LineOf(d_, std::abs(d));
    return std::copysign(T_[k] + K_[k] * (std::abs(d) - d_[k]), d);
  }
  double Deflection(double torque) const {
    const int k = LineOf(T_, std::abs(torque));
    return std::copysign(d_[k] + (std::abs(torque) - T_[k]) / K_[k], torque);
  }
  double stiffest() const { return K_[2]; }

 private:
  static int LineOf(const double* begins, double x) {
    return x < begins[1] ? 0 : x < begins[2] ? 1 : 2;
  }

  double K_[3], T_[3], d_[3];
};

// tau = WindUp(d) + c d', whose first slope k winds up by `windup` at the
// joint's torque scale. With the motor's own inertia it rings at
// sqrt(k (1/Im + 1/Il)): 225 rad/s for 50 N m, 1 mrad, 1 kg m^2 each.
HiddenEffect Elasticity() {
  return {"elasticity",
          true,
          Scope::kJoint,
          "A gear that winds up: the link lags its motor and rings after "
          "every reversal.",
          {{"windup", "1", .002, 3e-4, .01, Draw::kLog, 5e-5, .05},
           {"damping_ratio", "1", .05, .02, .1, Draw::kLog, .002, 1}},
          [](const EffectSite& site) -> std::vector<EffectValue> {
            const double I = MotorInertia(site);
            const double d0 = site.p[0] * site.radian();
            const double k = site.torque() / d0;
            const double c = 2 * site.p[1] * std::sqrt(k * I);
            const WindUp gear(k, site.torque());
            site.robot->transmissions.push_back(
                {site.index(),
                 {},
                 [=](double d, double rate, const double*, double*) {
                   return gear.Torque(d) + c * rate;
                 },
                 [=](double load) { return gear.Deflection(load); },
                 gear.stiffest()});
            const std::string unit =
                site.effort_unit() + "/" + site.position_unit();
            return {{"stiffness", unit, k},
                    {"damping",
                     site.effort_unit() + " s/" + site.position_unit(), c},
                    MotorValue(site)};
          },
          WhyTransmitted};
}

// A dead zone: tau = k x (1 + l x') while the flanks are pressed in by x > 0,
// never a pull (Hunt and Crossley 1975); nothing between the flanks. A tenth
// of the gap yields at the joint's torque scale, at least 0.2 mrad: flanks of
// small gaps are no stiffer.
HiddenEffect Backlash() {
  return {"backlash",
          true,
          Scope::kJoint,
          "Play in the gear: the link crosses a gap whenever its load changes "
          "sign, and only then.",
          {{"gap", "1", .005, 5e-4, .02, Draw::kLog, 5e-5, .1}},
          [](const EffectSite& site) -> std::vector<EffectValue> {
            MotorInertia(site);
            const double gap = site.p[0] * site.radian();
            const double yield = std::max(.1 * gap, 2e-4 * site.radian());
            const double k = site.torque() / yield;
            const double l = 2 / site.speed();
            const auto flank = [=](double x, double rate) {
              return x <= 0 ? 0 : k * x * std::max(0., 1 + l * rate);
            };
            site.robot->transmissions.push_back(
                {site.index(),
                 {},
                 [=](double d, double rate, const double*, double*) {
                   return flank(d - gap / 2, rate) - flank(-d - gap / 2, -rate);
                 },
                 // Starts pressed onto the flank that bears the load.
                 [=](double load) {
                   return load == 0 ? 0
                                    : std::copysign(gap / 2, load) + load / k;
                 },
                 k});
            return {{"backlash", site.position_unit(), gap},
                    {"contact_stiffness",
                     site.effort_unit() + "/" + site.position_unit(), k},
                    MotorValue(site)};
          },
          WhyTransmitted};
}

// tau = k (d - s) + c d', s' = r (tau_spring / T)^3: the belt creeps over its
// pulley, and motor and link lose each other for good.
HiddenEffect BeltSlip() {
  return {"belt_slip",
          false,
          Scope::kJoint,
          "A belt that creeps under load: the link drifts away from the motor "
          "that its encoder watches.",
          {{"creep", "1", .001, 1e-4, .005, Draw::kLog, 1e-5, .025},
           {"windup", "1", .002, 3e-4, .01, Draw::kLog, 3e-4, .05}},
          [](const EffectSite& site) -> std::vector<EffectValue> {
            const double I = MotorInertia(site), T = site.torque();
            const double creep = site.p[0] * site.speed();
            const double k = T / (site.p[1] * site.radian());
            const double c = .1 * std::sqrt(k * I);
            site.robot->transmissions.push_back(
                {site.index(), Eigen::VectorXd::Zero(1),
                 [=](double d, double rate, const double* state, double* slip) {
                   const double spring = k * (d - state[0]);
                   slip[0] = creep * std::pow(spring / T, 3);
                   return spring + c * rate;
                 },
                 [=](double load) { return load / k; }});
            return {{"creep", site.position_unit() + "/s", creep},
                    {"stiffness",
                     site.effort_unit() + "/" + site.position_unit(), k},
                    MotorValue(site)};
          },
          WhyTransmitted};
}

}  // namespace

std::vector<HiddenEffect> TransmissionEffects() {
  return {Elasticity(), Backlash(), BeltSlip()};
}

}  // namespace armcal

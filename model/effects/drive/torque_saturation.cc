#include <algorithm>
#include <cmath>
#include <vector>

#include "model/dynamics/motor_map.h"
#include "model/effects/effect_parts.h"

namespace armcal {
inline namespace effects {

namespace {

// What a limit with a rounded corner lets through: 0 at 0, with slope 1 far
// below it, `limit` far beyond.
struct SoftClip {
  explicit SoftClip(double knee) : knee(knee), most(SoftPlus(1 / knee)) {}
  double operator()(double x, double limit) const {
    const double w = knee * limit;
    const double passed = w * (most - SoftPlus((limit - std::abs(x)) / w));
    return std::copysign(passed, x);
  }
  double knee, most;
};

// Up to twice the largest torque that was asked for: a rounded corner is felt
// before the limit is reached, and a limit that falls is reached at higher
// speeds. A loop that winds up at its limit asks for far more than that: limits
// reach down to what is usual. Where nothing was asked for any limit will do.
std::vector<double> LimitsToTry(double top, double usual) {
  // The step is what a refinement bridges; the others are of the top.
  constexpr double kStep = 1.25, kHighest = 2, kLeast = .02;
  if (!(top > 0)) return {1};
  const double lowest = std::clamp(1.5 * usual / top, kLeast, .5);
  const int steps = static_cast<int>(
      std::ceil(std::log(kHighest / lowest) / std::log(kStep)));
  return GeometricGrid(lowest * top, kHighest * top, steps + 1);
}

// The motor's line between torque and speed: by Ohm's law a supply's voltage
// less what the motor itself makes drives the largest current,
//   limit(v) = usual_limit (1 - fall (v / usual speed - 1)), v along the
//   torque,
// so that usual_limit is that at the joint's usual speed; a motor that brakes
// has more. A current limit does not fall.
struct SpeedLine {
  SpeedLine(const EffectSite& site, const Eigen::VectorXd& p)
      : usual_limit(p[1]), fall(p[3]), usual_speed(SpeedScale(site)) {}
  double At(double velocity_along) const {
    return std::max(Least(), AtRest() - Slope() * velocity_along);
  }
  // From about the no-load speed on.
  static constexpr double kLeast = .01;  // of usual_limit
  double Least() const { return kLeast * usual_limit; }
  double AtRest() const { return usual_limit * (1 + fall); }
  double Slope() const { return usual_limit * fall / usual_speed; }
  double usual_limit, fall, usual_speed;
};

// What takes less than half of the excess, or half as much again, is no limit
// that a robot file could have; a tenth of it, or thrice as much, is none at
// all: a corner of another form than the real one is rounded otherwise, which
// the share makes up for.
bool IsALimit(double share) { return share > .5 && share < 1.5; }
bool MayBeALimit(double share) { return share > .1 && share < 3; }

double ValueOf(const std::vector<EffectEstimate>& estimates,
               const std::string& name) {
  return std::find_if(
             estimates.begin(), estimates.end(),
             [&](const EffectEstimate& one) { return one.name == name; })
      ->value;
}

// A limit that no recorded torque comes near does not show, at the largest
// speed either, at which it is least. The corner begins 3 of its widths below:
// there SoftPlus is 1/20 of a width. That recorded torques exceed it says
// nothing against one, however many do: what is limited is the torque given,
// and a loop whose motor gives too little asks for ever more.
bool IsReached(const EffectSite& site,
               const std::vector<EffectEstimate>& estimates) {
  constexpr double kCorner = 3;
  const MotionScale& scale = *site.scale;
  if (scale.top_torque.size() == 0 || scale.top_speed.size() == 0) return true;
  const double least =
      ValueOf(estimates, "limit") -
      ValueOf(estimates, "limit_slope") * scale.top_speed[site.joint];
  const double begin = 1 - kCorner * ValueOf(estimates, "knee");
  return begin * least <= scale.top_torque[site.joint];
}

bool IsOfALimit(const EffectSite& site,
                const std::vector<EffectEstimate>& estimates) {
  return MayBeALimit(ValueOf(estimates, "share")) && IsReached(site, estimates);
}

// A rounded corner has no field anywhere.
bool SetLimit(const EffectNumbers& numbers, JointDrive* drive) {
  // A fall of less than a twentieth by the usual speed is less than motors'
  // constants are known to.
  constexpr double kFlat = .05;
  if (!IsALimit(NumberOf(numbers, "share"))) return false;
  const double at_rest = NumberOf(numbers, "limit");
  const double usual = NumberOf(numbers, "least") / SpeedLine::kLeast;
  drive->torque_limit = at_rest;
  if (at_rest > (1 + kFlat) * usual) {
    drive->torque_limit_slope = NumberOf(numbers, "slope");
  }
  return true;
}

}  // namespace

// given = commanded - share (commanded - clip(commanded, limit)), share about
// 1: a current limit, or that of a supply's voltage, which falls with speed;
// its corner rounded over `knee` of it, as controllers and iron round it. What
// was asked beyond it shows in recorded torque alone (Motion::torque); without
// that the effect is invisible, and with a share far from 1 it is another
// effect.
Effect TorqueSaturation() {
  Effect effect;
  effect.name = "torque_saturation";
  effect.nature = Effect::Nature::kLaw;
  effect.law = "tau = share (tau_logged - clip(tau_logged, limit(v)))";
  effect.shows = "torques beyond the limit";
  effect.parameters = {
      Linear(
          "share", "1", [](const EffectSite&) { return 1.; },
          EffectParameter::Sign::kPositive),
      Gridded("usual_limit", "E",
              [](const EffectSite& site) {
                const Eigen::VectorXd& tops = site.scale->top_torque;
                return LimitsToTry(
                    tops.size() > 0 ? tops[site.joint] : 2 * TorqueScale(site),
                    TorqueScale(site));
              }),
      // Of a corner that is hardly seen to one over a quarter of the limit.
      Refined("knee", "1", {.02, .05, .08}),
      // None is tried as well, as of a current limit.
      Refined("fall", "1", {0, 0, .5, 1.5})};
  effect.unfit = WhyNotRecorded;
  effect.of_the_drive = true;
  effect.apply = [](const EffectSite& site, const Eigen::VectorXd& p,
                    SimulatedRobot* robot) {
    const double share = p[0];
    const SoftClip clip(p[2]);
    const SpeedLine line(site, p);
    const auto given = [=](double commanded, double velocity) {
      const double along = std::copysign(1, commanded) * velocity;
      return commanded - share * (commanded - clip(commanded, line.At(along)));
    };
    robot->actuators.push_back({{}, MotorMap{site.joint, given, {}}});
  };
  effect.estimates = [](const EffectSite& site, const Eigen::VectorXd& p) {
    const SpeedLine line(site, p);
    return std::vector<EffectEstimate>{
        {"limit", UnitAt(site, "E"), line.AtRest()},
        {"limit_slope", UnitAt(site, "E s/P"), line.Slope()},
        {"share", "1", p[0]},
        {"knee", "1", p[2]}};
  };
  effect.plausible = IsOfALimit;
  effect.set_drive = SetLimit;
  effect.proportional = false;
  effect.numbers = [](const EffectSite& site, const Eigen::VectorXd& p) {
    const SpeedLine line(site, p);
    return EffectNumbers{{"share", p[0]},
                         {"limit", line.AtRest()},
                         {"slope", line.Slope()},
                         {"least", line.Least()},
                         {"knee", p[2]}};
  };
  effect.experiment = "slow and fast accelerations of the same motion";
  return effect;
}

}  // namespace effects
}  // namespace armcal

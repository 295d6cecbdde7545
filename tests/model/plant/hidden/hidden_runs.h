#pragma once

#include <functional>
#include <string>
#include <vector>

#include "model/log_files/log.h"
#include "model/plant/hidden/hidden_effects.h"
#include "model/plant/reference_motion.h"

namespace armcal {

// Robots whose numbers are easy: links of 4 kg, centre of mass 0.3 m out along
// x, 0.5 kg m^2 about the joint's axis, a motor of 0.1 kg m^2.
inline constexpr double kMass = 4, kArm = .3, kInertia = .5, kMotor = .1;
inline constexpr double kGravity = 9.81;
inline constexpr double kWeight = kMass * kGravity * kArm;  // N m, held level

enum class Axis { kUpright, kLevel };  // of a joint; kLevel: q lifts the link
// The joint is `from_last` m along x from the one before.
Link EasyLink(const std::string& name, Axis axis, double from_last = 0);
Robot EasyRobot(const std::vector<Link>& links);
Robot Wheel();     // one joint, upright
Robot Pendulum();  // one joint, level

// How one joint moves: q - q0, its velocity and acceleration.
struct Profile {
  double duration;  // s
  std::function<Eigen::Vector3d(double t)> at;
};
Profile Hold(double duration);
Profile Sine(double amplitude, double hz, double duration);
// Constant velocities, rad/s, one after the other, each held, with smooth
// changes of 0.15 s before each; then rest.
Profile Plateaus(std::vector<double> velocities, double held);

// A simulated log by perfect sensors, and what the effect was.
struct HiddenRun {
  Log log;
  Eigen::MatrixXd link;  // true positions of the links at the samples
  double held = 0;       // of Plateaus
  std::vector<EffectValue> values;

  double Value(const std::string& name) const;
  // Means over samples from t0 to t1.
  double Mean(const Eigen::MatrixXd& signal, double t0, double t1,
              int joint = 0) const;
  double Torque(double t0, double t1, int joint = 0) const {
    return Mean(log.tau, t0, t1, joint);
  }
  // Torque of joint 0 on plateau k, settled.
  double Plateau(int k) const;
  // Mean torque of joint 0 within 20 mrad of q, moving in one direction.
  double TorqueNear(double q, int direction) const;
};
// The line of a signal at f Hz over samples from t0 on: its amplitude (cos,
// sin) by least squares beside a constant.
Eigen::Vector2d Line(const HiddenRun& run, const Eigen::VectorXd& signal,
                     double f, double t0 = 0);
// The frequency between low and high with the largest line, Hz.
double LoudestLine(const HiddenRun& run, const Eigen::VectorXd& signal,
                   double low, double high, double t0);

// A robot in a closed loop that knows it without the effect. Scales for every
// joint: 10 N m, 1 rad/s, 0.6 kg m^2.
struct HiddenLoop {
  HiddenLoop(const Robot& robot, const Profile& profile, int moving = 0);
  HiddenRun Run(const std::string& effect, int joint,
                const std::vector<double>& parameters) const;
  HiddenRun Without() const { return Run("", 0, {}); }

  ReferenceMotion Motion() const;  // refers to this

  Robot robot;
  Profile profile;
  int moving;
  Eigen::VectorXd q0;
  EffectContext context;
  double bandwidth_hz = 10;
  double held = .5;
  bool friction = false;  // the joints' own
  bool log_links = true;  // else log.temperature is temperature
};

// A row of the table: what the simulated log shows and what physics says.
void CheckEffect(const std::string& effect, const std::string& what,
                 double measured, double expected, double tolerance);

}  // namespace armcal

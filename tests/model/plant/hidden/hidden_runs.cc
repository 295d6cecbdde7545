#include "tests/model/plant/hidden/hidden_runs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "model/plant/closed_loop.h"
#include "model/plant/hidden/joint_friction.h"
#include "model/plant/simbody_arm.h"

namespace armcal {

using Eigen::Vector3d;
using Eigen::VectorXd;

namespace {

constexpr double kBlend = .15;  // s, between plateaus

}  // namespace

Link EasyLink(const std::string& name, Axis axis, double from_last) {
  Link link;
  link.name = name;
  link.joint.name = name + "_joint";
  link.joint.armature = kMotor;
  if (axis == Axis::kLevel) {
    link.X_PF.linear() =
        Eigen::AngleAxisd(M_PI / 2, Vector3d::UnitX()).matrix();
  }
  link.X_PF.translation().x() = from_last;
  link.inertial = InertialParameters::FromCenterOfMass(
      kMass, Vector3d(kArm, 0, 0),
      (kInertia - kMass * kArm * kArm) * Eigen::Matrix3d::Identity());
  link.has_inertial = true;
  return link;
}

Robot EasyRobot(const std::vector<Link>& links) {
  Robot robot;
  robot.name = "easy";
  robot.links = links;
  robot.X_LT.translation().x() = .5;
  return robot;
}
Robot Wheel() { return EasyRobot({EasyLink("a", Axis::kUpright)}); }
Robot Pendulum() { return EasyRobot({EasyLink("a", Axis::kLevel)}); }

Profile Hold(double duration) {
  return {duration, [](double) -> Vector3d { return Vector3d::Zero(); }};
}

Profile Sine(double amplitude, double hz, double duration) {
  const double w = 2 * M_PI * hz;
  return {duration, [=](double t) {
            return Vector3d(amplitude * (1 - std::cos(w * t)),
                            amplitude * w * std::sin(w * t),
                            amplitude * w * w * std::cos(w * t));
          }};
}

Profile Plateaus(std::vector<double> velocities, double held) {
  velocities.push_back(0);
  const double duration = velocities.size() * (kBlend + held);
  return {duration, [=](double t) {
            double q = 0, last = 0;
            const double turn = M_PI / kBlend;
            for (const double v : velocities) {
              const double s = std::clamp(t, 0., kBlend);
              q += last * s + (v - last) * (s - std::sin(turn * s) / turn) / 2;
              if (t < kBlend) {
                return Vector3d(
                    q, last + (v - last) * (1 - std::cos(turn * s)) / 2,
                    (v - last) * turn * std::sin(turn * s) / 2);
              }
              t -= kBlend;
              q += v * std::min(t, held);
              if (t < held) return Vector3d(q, v, 0);
              t -= held;
              last = v;
            }
            return Vector3d(q, 0, 0);
          }};
}

double HiddenRun::Value(const std::string& name) const {
  for (const EffectValue& value : values) {
    if (value.name == name) return value.value;
  }
  ADD_FAILURE() << "no value " << name;
  return 0;
}

double HiddenRun::Mean(const Eigen::MatrixXd& signal, double t0, double t1,
                       int joint) const {
  double sum = 0;
  int count = 0;
  for (int k = 0; k < log.size(); ++k) {
    if (log.t[k] < t0 || log.t[k] > t1) continue;
    sum += signal(k, joint);
    ++count;
  }
  EXPECT_GT(count, 0) << t0;
  return sum / count;
}

double HiddenRun::Plateau(int k) const {
  const double end = (k + 1) * (kBlend + held);
  return Torque(end - .4 * held, end - .01);
}

double HiddenRun::TorqueNear(double q, int direction) const {
  double sum = 0;
  int count = 0;
  for (int k = 0; k < log.size(); ++k) {
    if (std::abs(log.q(k, 0) - q) > .02) continue;
    if (log.qd(k, 0) * direction < .05) continue;
    sum += log.tau(k, 0);
    ++count;
  }
  EXPECT_GT(count, 0) << q;
  return sum / count;
}

Eigen::Vector2d Line(const HiddenRun& run, const VectorXd& signal, double f,
                     double t0) {
  const int first = static_cast<int>(
      std::lower_bound(run.log.t.begin(), run.log.t.end(), t0) -
      run.log.t.begin());
  const int n = run.log.size() - first;
  const auto phase = 2 * M_PI * f * run.log.t.tail(n).array();
  Eigen::MatrixXd A(n, 3);
  A << phase.cos().matrix(), phase.sin().matrix(), VectorXd::Ones(n);
  return A.colPivHouseholderQr().solve(signal.tail(n)).head<2>();
}

double LoudestLine(const HiddenRun& run, const VectorXd& signal, double low,
                   double high, double t0) {
  double best = low, loudest = 0;
  for (double f = low; f < high; f *= 1.005) {
    const double size = Line(run, signal, f, t0).norm();
    if (size <= loudest) continue;
    loudest = size;
    best = f;
  }
  return best;
}

HiddenLoop::HiddenLoop(const Robot& robot, const Profile& profile, int moving)
    : robot(robot),
      profile(profile),
      moving(moving),
      q0(VectorXd::Zero(robot.num_joints())) {
  const int n = robot.num_joints();
  context.torque = VectorXd::Constant(n, 10);
  context.speed = VectorXd::Ones(n);
  context.inertia = VectorXd::Constant(n, kInertia + kMotor);
  context.time_scale = context.duration = profile.duration;
}

ReferenceMotion HiddenLoop::Motion() const {
  return {profile.duration, [this](double t) {
            const Vector3d at = profile.at(std::clamp(t, 0., profile.duration));
            ReferencePoint point{q0, 0 * q0, 0 * q0};
            point.q[moving] += at[0];
            point.qd[moving] = at[1];
            point.qdd[moving] = at[2];
            return point;
          }};
}

HiddenRun HiddenLoop::Run(const std::string& effect, int joint,
                          const std::vector<double>& parameters) const {
  SimulatedRobot plant;
  plant.robot = robot;
  HiddenRun run;
  run.held = held;
  if (!effect.empty()) {
    run.values = ApplyHiddenEffect(
        *FindHiddenEffect(effect), &plant, joint,
        Eigen::Map<const VectorXd>(parameters.data(), parameters.size()),
        context);
  }
  if (friction) AddJointFriction(.005, &plant);
  if (log_links) {
    plant.sensors.push_back({[](const ArmInstant& at, Reading* reading) {
      reading->temperature = at.link_position.tail(reading->temperature.size());
    }});
  }
  ClosedLoopOptions options;
  options.controller = DefaultController(robot, q0, bandwidth_hz);
  options.sensors.log_rate_hz = 500;
  const ReferenceMotion motion = Motion();
  SimbodyArm arm(plant.robot);
  ClosedLoopRun simulated = RunClosedLoop(plant, robot, motion, options, &arm);
  EXPECT_TRUE(simulated.finite) << effect;
  run.log = simulated.log;
  run.link = simulated.log.temperature;
  return run;
}

void CheckEffect(const std::string& effect, const std::string& what,
                 double measured, double expected, double tolerance) {
  std::printf("%-21s %-50s %10.5f %10.5f\n", effect.c_str(), what.c_str(),
              measured, expected);
  EXPECT_NEAR(measured, expected, tolerance) << effect << ": " << what;
}

}  // namespace armcal

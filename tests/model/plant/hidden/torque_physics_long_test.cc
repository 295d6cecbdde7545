// What simulated logs show of transmissions and of torques of position and
// time: a table of effect, what is measured, its value in the log, its value by
// hand.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/model/plant/hidden/hidden_runs.h"

namespace armcal::torque_physics_long_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kJ = kInertia + kMotor;

double Rms(const VectorXd& x) { return x.norm() / std::sqrt(x.size()); }

// Pushed once and then let go (a loop of 0.05 Hz), motor and link ring against
// one another.
TEST(HiddenTransmissionPhysics, ElasticityRings) {
  HiddenLoop loop(Wheel(), Plateaus({.2}, 2));
  loop.profile.duration = 2;  // before it would stop
  loop.bandwidth_hz = .05;
  loop.context.torque[0] = 5;
  const HiddenRun run = loop.Run("elasticity", 0, {.01, .02});
  const double k = run.Value("stiffness");
  const VectorXd qd = run.log.qd.col(0), rigid = loop.Without().log.qd.col(0);
  CheckEffect("elasticity", "two-mass frequency, Hz",
              LoudestLine(run, qd - rigid, 8, 20, .2),
              std::sqrt(k * (1 / kMotor + 1 / kInertia)) / (2 * M_PI), .15);

  HiddenLoop held(Pendulum(), Hold(2));
  const HiddenRun hangs = held.Run("elasticity", 0, {.01, .02});
  // 1000 N m/rad to 3 N m, 1300 to 10 N m, 1500 beyond, where the weight is.
  static_assert(kWeight > 10);
  const double d = .003 + 7. / 1300 + (kWeight - 10) / 1500;
  CheckEffect("elasticity", "motor ahead of its link, mrad",
              1e3 * hangs.Mean(hangs.log.q - hangs.link, 1, 2), 1e3 * d, .02);
}

// Hanging, the load changes sign at the bottom; held out, it never does.
TEST(HiddenTransmissionPhysics, BacklashNeedsAReversal) {
  HiddenLoop loop(Pendulum(), Sine(.5, .25, 4));
  loop.q0[0] = -M_PI / 2 - .5;
  HiddenRun run = loop.Run("backlash", 0, {.005});
  const double k = run.Value("contact_stiffness");
  MatrixXd play = run.log.q - run.link;
  // At the ends of the swing the flanks bear weight less inertia.
  const double load =
      kWeight * std::sin(.5) - kInertia * .5 * std::pow(2 * M_PI * .25, 2);
  CheckEffect("backlash", "motor against link from end to end, mrad",
              1e3 * (run.Mean(play, 1.9, 2.1) - run.Mean(play, 3.9, 4)),
              1e3 * (.005 + 2 * load / k), .1);
  const double reversing =
      Rms(run.log.tau.col(0) - loop.Without().log.tau.col(0));

  loop.q0[0] = -.5;
  run = loop.Run("backlash", 0, {.005});
  play = run.log.q - run.link;
  const VectorXd play_on = play.col(0).tail(1900);
  // The flank gives way to weight and inertia, at all phases of the swing.
  double least = kWeight, most = 0;
  for (double phase = 0; phase < M_PI; phase += .01) {
    const double load =
        kWeight * std::cos(.5 * std::cos(phase)) +
        kInertia * .5 * std::pow(2 * M_PI * .25, 2) * std::cos(phase);
    least = std::min(least, load);
    most = std::max(most, load);
  }
  CheckEffect("backlash", "the same where the load keeps its sign, mrad",
              1e3 * (play_on.maxCoeff() - play_on.minCoeff()),
              1e3 * (most - least) / k, .005);
  const VectorXd change = run.log.tau.col(0) - loop.Without().log.tau.col(0);
  CheckEffect("backlash", "torque's change there over that of reversals",
              Rms(change.tail(1900)) / reversing, 0, .1);
}

TEST(HiddenTransmissionPhysics, BeltLosesTheLink) {
  const HiddenLoop loop(Pendulum(), Hold(3));
  const HiddenRun run = loop.Run("belt_slip", 0, {.001, .002});
  const MatrixXd lost = run.log.q - run.link;
  CheckEffect("belt_slip", "creep under the weight, mrad/s",
              1e3 * (run.Mean(lost, 2.9, 3) - run.Mean(lost, .9, 1)) / 2,
              std::pow(kWeight / 10, 3), .02);
}

TEST(HiddenTorquePhysics, OfThePosition) {
  HiddenLoop loop(Wheel(), Plateaus({1, -1}, 2));
  HiddenRun run = loop.Run("spring", 0, {.2, .5});
  CheckEffect("spring", "torque 1 rad beyond its neutral",
              run.TorqueNear(1.5, 1), 2 * 2 * std::sinh(.5), .05);
  CheckEffect("spring", "the same on the way back", run.TorqueNear(1.5, -1),
              2 * 2 * std::sinh(.5), .05);
  run = loop.Run("cable", 0, {.1, .5, .1});
  CheckEffect("cable", "torque far to one side", run.TorqueNear(1.7, 1),
              2 / M_PI * std::atan(12), .02);
  CheckEffect("cable", "torque to the other", run.TorqueNear(.2, -1),
              -2 / M_PI * std::atan(3), .03);

  loop.profile = Plateaus({.2}, 5);
  run = loop.Run("torque_ripple", 0, {.05, 20, .3});
  const int n = 2300, first = 200;
  const VectorXd q = run.log.q.col(0).segment(first, n);
  MatrixXd waves(n, 7);
  waves << VectorXd::Ones(n), (20 * q).array().sin().matrix(),
      (20 * q).array().cos().matrix(), (40 * q).array().sin().matrix(),
      (40 * q).array().cos().matrix(), (27 * q).array().sin().matrix(),
      (27 * q).array().cos().matrix();
  const VectorXd fit =
      waves.colPivHouseholderQr().solve(run.log.tau.col(0).segment(first, n));
  // sin f / (1 - e cos f) = 2 / e (b sin f + b^2 sin 2f + ..), e = 0.3.
  const double b = (1 - std::sqrt(1 - .09)) / .3;
  CheckEffect("torque_ripple", "wave of 20 per turn", fit.segment(1, 2).norm(),
              .5 * 2 / .3 * b, .02);
  CheckEffect("torque_ripple", "its overtone", fit.segment(3, 2).norm(),
              .5 * 2 / .3 * b * b, .01);
  CheckEffect("torque_ripple", "wave of 27 per turn", fit.segment(5, 2).norm(),
              0, .02);
}

TEST(HiddenTorquePhysics, OfTime) {
  HiddenLoop loop(Wheel(), Hold(3));
  const HiddenRun drift = loop.Run("time_drift", 0, {.1});
  CheckEffect("time_drift", "torque after a third of the log",
              drift.Torque(.98, 1.02), .5, .01);
  CheckEffect("time_drift", "torque at its end", drift.Torque(2.96, 3), 1, .02);

  const HiddenRun shaken = loop.Run("vibration", 0, {.05, 6});
  const VectorXd tau = shaken.log.tau.col(0), q = shaken.log.q.col(0);
  CheckEffect("vibration", "frequency, Hz", LoudestLine(shaken, tau, 3, 15, 0),
              6, .1);
  // What the wheel's motion leaves of the logged torque.
  const Eigen::Vector2d left =
      -kJ * std::pow(2 * M_PI * 6, 2) * Line(shaken, q, 6) -
      Line(shaken, tau, 6);
  CheckEffect("vibration", "amplitude", left.norm(), .5, .05);

  loop.profile = Hold(10);
  const auto disturbance = [&loop] {
    const HiddenRun run = loop.Run("random_torque", 0, {.1});
    const int n = run.log.size() - 20;
    const VectorXd at = run.log.q.col(0);
    return VectorXd(kJ * (at.tail(n) - 2 * at.segment(10, n) + at.head(n)) /
                        4e-4 -
                    run.log.tau.col(0).segment(10, n));
  };
  const VectorXd one = disturbance();
  CheckEffect("random_torque", "rms over 10 s (over long: 1)", Rms(one), 1,
              .35);
  loop.context.seed = 1;
  const VectorXd other = disturbance();
  EXPECT_LT(std::abs(one.dot(other)) / (one.norm() * other.norm()), .5);
}

}  // namespace armcal::torque_physics_long_test

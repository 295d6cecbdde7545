// What simulated logs show of drives, sensors and the clock: a table of effect,
// what is measured, its value in the log, its value by hand.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/model/plant/hidden/hidden_runs.h"

namespace armcal::drive_physics_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kJ = kInertia + kMotor;

// The command x > 0 for which given(x) is `torque`, by bisection.
double Command(double torque, const std::function<double(double)>& given) {
  double low = 0, high = 100;
  for (int k = 0; k < 60; ++k) {
    const double x = (low + high) / 2;
    (given(x) < torque ? low : high) = x;
  }
  return low;
}

// A pendulum held level needs its weight times its arm; the log holds what was
// commanded for it.
TEST(HiddenDrivePhysics, HeldAgainstItsWeight) {
  const HiddenLoop loop(Pendulum(), Hold(2));
  const auto held = [](const HiddenRun& run) { return run.Torque(1, 2); };
  EXPECT_NEAR(held(loop.Without()), kWeight, .005);
  CheckEffect("torque_offset", "torque held, less the weight's",
              held(loop.Run("torque_offset", 0, {.05})) - kWeight, .5, .005);
  CheckEffect("torque_gain", "torque held over the weight's",
              held(loop.Run("torque_gain", 0, {.1})) / kWeight, 1.1, .001);
  CheckEffect("torque_nonlinearity", "torque held",
              held(loop.Run("torque_nonlinearity", 0, {.1})),
              Command(kWeight,
                      [](double x) {
                        const double x2 = x * x / 400;
                        return x * (1 - .2 * x2 / (1 + x2));
                      }),
              .01);
  CheckEffect("torque_deadband", "torque held, less the weight's",
              held(loop.Run("torque_deadband", 0, {.05})) - kWeight, .5, .005);
  // Heat follows the torque squared over a quarter of the log: the loss grows.
  const HiddenRun warm = loop.Run("warming_motor", 0, {.1});
  double heat = 0, torque = kWeight;
  for (double t = -1; t < 1.9; t += .001) {  // a second of settling before
    heat += .001 * (torque * torque / 100 - heat) / .5;
    torque = kWeight / (1 - .1 * heat);
  }
  CheckEffect("warming_motor", "torque held at the end",
              warm.Torque(1.85, 1.95), torque, .05);
}

// A limit caps how fast a wheel can start.
TEST(HiddenDrivePhysics, SaturationClips) {
  HiddenLoop loop(Wheel(), Sine(.3, 1.2, 2.5));
  loop.context.torque[0] = 5;
  const HiddenRun run = loop.Run("torque_saturation", 0, {1.4, 0});
  const auto largest = [](const HiddenRun& of) {
    double most = 0;
    for (int k = 100; k + 5 < of.log.size(); ++k) {
      const double qdd =
          (of.log.q(k + 5, 0) - 2 * of.log.q(k, 0) + of.log.q(k - 5, 0)) / 1e-4;
      most = std::max(most, std::abs(kJ * qdd));
    }
    return most;
  };
  CheckEffect("torque_saturation", "free: inertia's largest torque",
              largest(loop.Without()), kJ * .3 * std::pow(2 * M_PI * 1.2, 2),
              .15);
  CheckEffect("torque_saturation", "limited to", largest(run), 7, .15);
  EXPECT_GT(run.log.tau.maxCoeff(), 8);  // asked for
}

TEST(HiddenDrivePhysics, CrosstalkAndSag) {
  HiddenLoop loop(EasyRobot({EasyLink("a", Axis::kUpright),
                             EasyLink("b", Axis::kLevel, .4)}),
                  Hold(2));
  EXPECT_NEAR(loop.Without().Torque(1, 2), 0, .005);
  const HiddenRun run = loop.Run("torque_crosstalk", 0, {.05});
  CheckEffect("torque_crosstalk", "torque held upright, neighbour's times gain",
              run.Torque(1, 2), .05 * kWeight, .01);

  Robot wheel = Wheel();
  wheel.links[0].joint.viscous = 6;
  HiddenLoop turning(wheel, Plateaus({1}, 1.5));
  turning.held = 1.5;
  turning.friction = true;
  EXPECT_NEAR(turning.Without().Plateau(0), 6, .01);
  // x (1 - 0.2 p / (p + 10)) = 6 at the power p = x of 1 rad/s.
  CheckEffect("supply_sag", "torque against 6 N m at 1 rad/s",
              turning.Run("supply_sag", -1, {.2}).Plateau(0),
              Command(6, [](double x) { return x * (1 - .2 * x / (x + 10)); }),
              .03);
}

// Torque leads the acceleration that it makes by the delay.
TEST(HiddenDrivePhysics, DelayShiftsPhase) {
  const HiddenLoop loop(Wheel(), Sine(.3, 1, 5));
  const auto lead = [](const HiddenRun& run) {
    const Eigen::Vector2d tau = Line(run, run.log.tau.col(0), 1, 1);
    const Eigen::Vector2d q = Line(run, run.log.q.col(0), 1, 1);
    // cos(wt - p) has the line (cos p, sin p); acceleration is -w^2 q.
    return std::remainder(std::atan2(-q[1], -q[0]) - std::atan2(tau[1], tau[0]),
                          2 * M_PI) /
           (2 * M_PI);
  };
  const double free = lead(loop.Without());
  EXPECT_NEAR(free, 0, .0012);  // of a torque held over a period
  for (const double delay : {.003, .006}) {
    CheckEffect("delay", "torque before acceleration, ms",
                1e3 * (lead(loop.Run("delay", -1, {delay})) - free),
                1e3 * delay, .15);
  }
}

TEST(HiddenSensorPhysics, PositionsThatAreWrong) {
  HiddenLoop loop(Pendulum(), Hold(2));
  loop.q0[0] = .8;
  const HiddenRun shifted = loop.Run("encoder_offset", 0, {.05});
  EXPECT_NEAR(loop.Without().Torque(1, 2), kWeight * std::cos(.8), .005);
  CheckEffect("encoder_offset", "gravity torque beyond the logged position's",
              shifted.Torque(1, 2) - kWeight * std::cos(.8),
              kWeight * (std::cos(.75) - std::cos(.8)), .01);
  // The pendulum is where its torque says, not where the log says.
  loop.profile = Hold(6);
  const HiddenRun loose = loop.Run("wandering_encoder", 0, {.005});
  // Every 20 ms; what moves the link, which the log does not see, is taken off.
  const int n = loose.log.size() - 20;
  const VectorXd link = loose.link.col(0);
  const VectorXd torque =
      loose.log.tau.col(0).segment(10, n) -
      kJ / 4e-4 * (link.tail(n) - 2 * link.segment(10, n) + link.head(n));
  VectorXd error = loose.log.q.col(0).segment(10, n) - link.segment(10, n);
  error.array() -= error.mean();
  EXPECT_GT(error.norm() / std::sqrt(n), 1e-3);
  CheckEffect("wandering_encoder", "torque over the log's error, N m/rad",
              error.dot(torque) / error.squaredNorm(), kWeight * std::sin(.8),
              .05);
  EXPECT_NEAR((loop.Without().log.q - loop.Without().link).norm(), 0, 1e-9);

  HiddenLoop turn(Wheel(), Plateaus({2, -2}, 1.5));
  const HiddenRun disc = turn.Run("encoder_eccentricity", 0, {.01, 0});
  const VectorXd off = (disc.log.q - disc.link).col(0);
  const VectorXd wave = disc.link.col(0).array().sin();
  CheckEffect("encoder_eccentricity", "once per turn, mrad",
              1e3 * off.dot(wave) / wave.squaredNorm(), 10, .1);
}

TEST(HiddenSensorPhysics, VelocitiesAndTimeThatAreWrong) {
  HiddenLoop loop(Wheel(), Plateaus({1}, 3));
  loop.context.time_scale = 3;
  const HiddenRun old = loop.Run("aging_tachometer", 0, {.2});
  const double true_speed = (old.link(1490, 0) - old.link(1410, 0)) / .16;
  CheckEffect("aging_tachometer", "logged over true velocity at 2.9 s",
              old.Mean(old.log.qd, 2.82, 2.98) / true_speed,
              1 - .2 * (1 - std::exp(-2 * 2.9 / 3)), .003);

  loop.profile = Plateaus({1}, 7.5);
  const HiddenRun fast = loop.Run("time_base", -1, {.01});
  // The first half of the 15 s wave, of mean zero over the whole.
  const int k = 3700;  // 7.4 s
  CheckEffect(
      "time_base", "stamp of 7.4 s", fast.log.t[k],
      7.4 + .01 * (7.4 + .3 * 15 / (2 * M_PI) * std::sin(2 * M_PI * 7.4 / 15)),
      1e-6);
  CheckEffect("time_base", "velocity by stamps at 7.4 s, clock slow there",
              (fast.log.q(k + 20, 0) - fast.log.q(k - 20, 0)) /
                  (fast.log.t[k + 20] - fast.log.t[k - 20]),
              1 / (1 + .01 * .7), 2e-4);
}

}  // namespace armcal::drive_physics_test

#include "model/signals/delayed_signal.h"

#include <gtest/gtest.h>

#include <cmath>

#include "model/dynamics/recorded_torque.h"
#include "model/effects/effects.h"
#include "tests/fixtures/two_link_arm.h"

namespace armcal::delayed_signal_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kStep = .002;  // s
constexpr int kSamples = 2000;

TEST(Delayed, IsWhatWasBefore) {
  const MatrixXd ramp = VectorXd::LinSpaced(11, 0, 10);
  EXPECT_NEAR(Delayed(ramp, 2.25)(5, 0), 2.75, 1e-12);
  EXPECT_NEAR(Delayed(ramp, -2.25)(5, 0), 7.25, 1e-12);
  EXPECT_NEAR(Delayed(ramp, 3)(1, 0), -2, 1e-12) << "before the first sample";
  EXPECT_NEAR(Delayed(ramp, -3)(9, 0), 12, 1e-12) << "after the last";
  EXPECT_EQ(Delayed(ramp, 0), ramp);
  EXPECT_EQ(Delayed(ramp.topRows(1), .5)(0, 0), 0) << "of one sample";
}

// A fifth of the sampling rate, between samples, where a line through the two
// neighbours would leave .81 of it.
TEST(Delayed, KeepsFastSines) {
  const auto sine = [](double at) { return std::sin(2 * M_PI * at / 5); };
  const MatrixXd signal = VectorXd::NullaryExpr(
      50, [&](Eigen::Index k) { return sine(static_cast<double>(k)); });
  for (const double delay : {.5, -.5, 3.5}) {
    const MatrixXd delayed = Delayed(signal, delay);
    for (int k = 10; k < 40; ++k) {
      EXPECT_NEAR(delayed(k, 0), sine(k - delay), .016) << delay << " " << k;
    }
  }
}

// The textbook's torque at another time is what the log of a robot holds whose
// motors lag behind their commands (the log is ahead), or whose log is late.
TEST(Delay, EitherSignIsTheTorqueOfAnotherTime) {
  const TwoLinkArm arm;
  const Trajectory recorded = arm.Record(kStep, kSamples);
  Motion motion;
  motion.dt = kStep;
  motion.q = recorded.q;
  motion.qd = recorded.qd;
  motion.qdd = recorded.qdd;
  const Robot robot = arm.ToRobot();
  RecordedTorque torque(robot, {2, CoulombTransition()}, motion);
  for (const double delay : {.003, -.003, -.015}) {
    SimulatedRobot changed;
    changed.robot = robot;
    FindEffect("delay")->apply({&robot, -1, nullptr},
                               VectorXd::Constant(1, delay), &changed);
    const MatrixXd change = torque.Change(changed);
    double worst = 0, most = 0;
    for (int k = 100; k < kSamples - 100; ++k) {
      Eigen::Vector2d q, qd, qdd, q1, qd1, qdd1;
      TwoLinkArm::Motion(motion.time(k), &q, &qd, &qdd);
      TwoLinkArm::Motion(motion.time(k) + delay, &q1, &qd1, &qdd1);
      const Eigen::RowVector2d expected =
          (arm.Torque(q1, qd1, qdd1) - arm.Torque(q, qd, qdd)).transpose();
      worst = std::max(worst, (change.row(k) - expected).norm());
      most = std::max(most, expected.norm());
    }
    EXPECT_LT(worst, .05 * most) << delay;
    EXPECT_GT(most, .02) << delay;
  }
}

}  // namespace armcal::delayed_signal_test

#include "model/dynamics/joint_controller.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/fixtures/two_link_arm.h"

namespace armcal::joint_controller_test {

using Eigen::Vector2d;
using Eigen::VectorXd;

ControllerOptions PlainGains() {
  ControllerOptions options;
  options.rate_hz = 100;
  options.drives.resize(2);
  options.drives[0].kp = 10;
  options.drives[0].kd = 1;
  options.drives[1].kp = 20;
  options.drives[1].kd = 2;
  options.drives[1].ki = 5;
  options.feedforward = Feedforward::kNone;
  return options;
}

ReferencePoint At(double q1, double q2) {
  return {Vector2d(q1, q2), Vector2d(.5, 0), Vector2d::Zero()};
}

TEST(JointController, IsProportionalDifferentialIntegral) {
  JointController controller(PlainGains(), TwoLinkArm().ToRobot());
  const VectorXd tachometer = Vector2d(.2, .1);
  VectorXd tau = controller.Update(At(.3, .4), Vector2d(.1, .1), tachometer);
  EXPECT_NEAR(tau[0], 10 * .2 + 1 * .3, 1e-12);
  EXPECT_NEAR(tau[1], 20 * .3 - 2 * .1, 1e-12);
  tau = controller.Update(At(.3, .4), Vector2d(.1, .1), tachometer);
  EXPECT_NEAR(tau[1], 20 * .3 - 2 * .1 + 5 * .3 / 100, 1e-12);
}

// Positions that rise by v per second are seen as velocity v once the filter
// has settled.
TEST(JointController, DifferencesPositions) {
  ControllerOptions options = PlainGains();
  options.velocity_filter_hz = 5;
  DifferencedVelocity velocity(options);
  VectorXd last = VectorXd::Ones(2);
  for (int k = 0; k < 100; ++k) {
    last = velocity.Update(Vector2d(.3, -.2) * k / 100);
    if (k > 0) continue;
    EXPECT_EQ(last.norm(), 0);
  }
  EXPECT_NEAR(last[0], .3, 1e-9);
  EXPECT_NEAR(last[1], -.2, 1e-9);
}

TEST(JointController, IntegralStopsAtTheLimit) {
  ControllerOptions options = PlainGains();
  options.drives[0].torque_limit = 1;
  options.drives[1].torque_limit = 3;
  JointController controller(options, TwoLinkArm().ToRobot());
  const VectorXd still = Vector2d::Zero();
  for (int k = 0; k < 1000; ++k) {
    const VectorXd tau = controller.Update(At(1, 1), still, still);
    EXPECT_EQ(tau[1], 3);
    EXPECT_TRUE(controller.at_limit());
  }
  // The error changes sign: nothing has been wound up.
  const VectorXd tau = controller.Update(At(0, -.1), still, still);
  EXPECT_NEAR(tau[1], -20 * .1, 1e-9);
}

// Critically damped at 5 Hz for the inertia that the outer joint feels, which
// is the textbook's m2 lc2^2 + I2, plus its armature.
TEST(JointController, DefaultGainsPlaceTheLoop) {
  const TwoLinkArm arm;
  Robot robot = arm.ToRobot();
  robot.links[1].joint.armature = .1;
  const ControllerOptions options =
      DefaultController(robot, Vector2d(.3, .7), 5);
  const double omega = 2 * M_PI * 5;
  const double inertia = arm.m2 * arm.lc2 * arm.lc2 + arm.I2 + .1;
  EXPECT_NEAR(options.drives[1].kp, omega * omega * inertia, 1e-9);
  EXPECT_NEAR(options.drives[1].kd, 2 * omega * inertia, 1e-9);
}

}  // namespace armcal::joint_controller_test

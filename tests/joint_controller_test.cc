#include "model/plant/joint_controller.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>

#include "model/input_error.h"
#include "tests/temp_file.h"
#include "tests/two_link_arm.h"

namespace armcal {
namespace {

using Eigen::Vector2d;
using Eigen::VectorXd;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

ControllerOptions PlainGains() {
  ControllerOptions options;
  options.rate_hz = 100;
  options.kp = Vector2d(10, 20);
  options.kd = Vector2d(1, 2);
  options.ki = Vector2d(0, 5);
  options.torque_limit = Vector2d(kInfinity, kInfinity);
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
  options.torque_limit = Vector2d(1, 3);
  JointController controller(options, TwoLinkArm().ToRobot());
  const VectorXd still = Vector2d::Zero();
  for (int k = 0; k < 1000; ++k) {
    const VectorXd tau = controller.Update(At(1, 1), still, still);
    EXPECT_EQ(tau[1], 3);
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
  EXPECT_NEAR(options.kp[1], omega * omega * inertia, 1e-9);
  EXPECT_NEAR(options.kd[1], 2 * omega * inertia, 1e-9);
}

TEST(ReadController, ReadsEveryKey) {
  const Robot robot = TwoLinkArm().ToRobot();
  const std::string path = WriteFile(
      "rate: 500\nkp: [1, 2]\nkd: [3, 4]\nki: [5, 6]\n"
      "torque_limit: [7, 8]\nvelocity_filter: 9\nfeedforward: gravity\n",
      "controller.yaml");
  const ControllerOptions options = ReadController(path, robot, Vector2d(0, 0));
  EXPECT_EQ(options.rate_hz, 500);
  EXPECT_EQ(options.kp, Vector2d(1, 2));
  EXPECT_EQ(options.kd, Vector2d(3, 4));
  EXPECT_EQ(options.ki, Vector2d(5, 6));
  EXPECT_EQ(options.torque_limit, Vector2d(7, 8));
  EXPECT_EQ(options.velocity_filter_hz, 9);
  EXPECT_EQ(options.feedforward, Feedforward::kGravity);
}

TEST(ReadController, RefusesWhatIsWrong) {
  const Robot robot = TwoLinkArm().ToRobot();
  const auto refusal = [&](const std::string& text) -> std::string {
    const std::string path = WriteFile(text, "controller.yaml");
    try {
      ReadController(path, robot, Vector2d(0, 0));
    } catch (const InputError& error) {
      return error.what();
    }
    return "accepted";
  };
  using testing::HasSubstr;
  EXPECT_THAT(refusal("kp: [1]\n"), HasSubstr("expected 2 numbers, one per"));
  EXPECT_THAT(refusal("kp: [1, -1]\n"), HasSubstr("at least 0"));
  EXPECT_THAT(refusal("rate: 0\n"), HasSubstr("expected a number above 0"));
  EXPECT_THAT(refusal("gain: 3\n"), HasSubstr("gain"));
  EXPECT_THAT(refusal("feedforward: full\n"), HasSubstr("inverse_dynamics"));
}

}  // namespace
}  // namespace armcal

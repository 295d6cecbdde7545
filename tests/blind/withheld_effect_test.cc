#include "tests/blind/withheld_effect.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/blind/real_log.h"
#include "tests/blind/withheld_size.h"
#include "tests/fixtures/two_link_arm.h"

namespace armcal::withheld_effect_test {

using Eigen::Vector2d;
using Eigen::VectorXd;

// Of the textbook arm, at unequal steps, with noise of this standard deviation.
Log Record(double duration, double noise, int seed) {
  const TwoLinkArm arm;
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal(0, noise);
  const int size = static_cast<int>(duration / .01);
  Log log;
  log.t.resize(size);
  log.q.resize(size, 2);
  log.tau.resize(size, 2);
  for (int k = 0; k < size; ++k) {
    log.t[k] = .01 * k + (k % 3 == 1 ? .002 : 0);
    Vector2d q, qd, qdd;
    TwoLinkArm::Motion(log.t[k], &q, &qd, &qdd);
    log.q.row(k) = q;
    log.tau.row(k) = arm.Torque(q, qd, qdd);
    log.tau(k, 0) += normal(random);
    log.tau(k, 1) += normal(random);
  }
  return log;
}

// At rest, where torques are those of levers.
Log Rest(const Vector2d& q) {
  Log log;
  log.t = VectorXd::LinSpaced(401, 0, 4);
  log.q = q.transpose().replicate(401, 1);
  log.tau.setZero(401, 2);
  return log;
}

TEST(WithheldEffect, PayloadIsALever) {
  const TwoLinkArm arm;
  const Vector2d q(.4, -.9);
  const double m = 1.7, x = .06;
  const WithheldEffect payload = {"payload", -1, m, Eigen::Vector3d(x, 0, 0)};
  const Log log = WithEffect(arm.ToRobot(), payload, Rest(q));
  const double second = m * arm.g * (arm.l2 + x) * std::cos(q[0] + q[1]);
  EXPECT_NEAR(log.tau(200, 1), second, 1e-9);
  EXPECT_NEAR(log.tau(200, 0), second + m * arm.g * arm.l1 * std::cos(q[0]),
              1e-9);
}

// Motors hold against a force of the environment: with J of the textbook.
TEST(WithheldEffect, ContactIsJacobianTransposed) {
  const TwoLinkArm arm;
  const Vector2d q(.4, -.9);
  VectorXd shape(5);
  shape << 2, 1, .6, .8, 0;
  const WithheldEffect contact = {"external_contact", -1, 30, shape};
  const Log log = WithEffect(arm.ToRobot(), contact, Rest(q));
  const double s1 = std::sin(q[0]), c1 = std::cos(q[0]);
  const double s12 = std::sin(q[0] + q[1]), c12 = std::cos(q[0] + q[1]);
  const double fx = 18, fy = 24;
  EXPECT_NEAR(log.tau(200, 1), -arm.l2 * (-s12 * fx + c12 * fy), 1e-6);
  EXPECT_NEAR(
      log.tau(200, 0),
      -(-(arm.l1 * s1 + arm.l2 * s12) * fx + (arm.l1 * c1 + arm.l2 * c12) * fy),
      1e-6);
  EXPECT_EQ(log.tau(100, 0), 0) << "outside its second";
}

TEST(WithheldEffect, SignalsAreShiftedAndScaled) {
  const TwoLinkArm arm;
  const Log log = Record(6, 0, 1);
  const auto with = [&](const std::string& name, int joint, double size) {
    return WithEffect(arm.ToRobot(), {name, joint, size, {}}, log);
  };
  EXPECT_NEAR(with("encoder_offset", 1, .02).q(300, 1), log.q(300, 1) + .02,
              1e-12);
  EXPECT_NEAR(with("torque_gain", 0, -.1).tau(300, 0), .9 * log.tau(300, 0),
              1e-9);
  EXPECT_NEAR(with("time_base", -1, .03).t[300], 1.03 * log.t[300], 1e-12);
  // Given later than it was recorded: what is recorded is ahead.
  const Log ahead = with("delay", -1, .025);
  Vector2d q, qd, qdd;
  TwoLinkArm::Motion(log.t[300] + .025, &q, &qd, &qdd);
  EXPECT_NEAR(ahead.tau(300, 0), arm.Torque(q, qd, qdd)[0], .1);
  TwoLinkArm::Motion(log.t[300], &q, &qd, &qdd);
  EXPECT_NEAR(with("viscous_friction", 1, 2).tau(300, 1) - log.tau(300, 1),
              2 * qd[1], .02);
}

// A term that the model has, changed between two logs of the same motion: the
// best that fits both is half way, and leaves half the squares in each.
TEST(WithheldSize, IsWhatBothLogsTogetherCannotAbsorb) {
  const TwoLinkArm arm;
  const Log reference = Record(40, .5, 1), log = UniformLog(Record(40, .5, 2));
  WithheldSizer sizer(arm.ToRobot(), reference);
  EXPECT_LT(sizer.noise_rms().maxCoeff(), .5);
  const EffectSize size = sizer.Size({"viscous_friction", 1, .4, {}}, log);
  EXPECT_NEAR(size.enr / size.raw, std::sqrt(.5), .02);
  // In proportion to the effect.
  EXPECT_NEAR(sizer.Size({"viscous_friction", 1, .8, {}}, log).enr,
              2 * size.enr, 1e-6 * size.enr);
}

// Noise that is larger than what interpolation and filters leave. White noise
// at 100 Hz has a fifth of its power below 10 Hz.
TEST(WithheldSize, IsInUnitsOfTheNoise) {
  const TwoLinkArm arm;
  const Log log = UniformLog(Record(40, .5, 2));
  WithheldSizer quiet(arm.ToRobot(), Record(40, 3, 1));
  WithheldSizer loud(arm.ToRobot(), Record(40, 9, 1));
  EXPECT_NEAR(quiet.noise_rms()[0], 3 * std::sqrt(.2), .15);
  EXPECT_NEAR(loud.noise_rms()[0], 9 * std::sqrt(.2), .45);
  const WithheldEffect ripple = {"torque_ripple", 0, .3, Vector2d(9, .3)};
  EXPECT_NEAR(quiet.Size(ripple, log).enr / loud.Size(ripple, log).enr, 3, .2);
}

TEST(WithheldEffect, IsDrawnWithinItsRange) {
  const Robot robot = TwoLinkArm().ToRobot();
  const VectorXd usual = Vector2d(10, 4);
  for (const std::string& name : WithheldEffectNames()) {
    std::mt19937_64 random(7), same(7);
    const auto drawn = DrawWithheldEffect(name, robot, usual, 20, &random);
    const auto again = DrawWithheldEffect(name, robot, usual, 20, &same);
    EXPECT_EQ(drawn.size, again.size) << name;
    const SizeRange range = RangeOf(drawn, usual);
    EXPECT_GE(std::abs(drawn.size), range.least) << name;
    EXPECT_LE(std::abs(drawn.size), range.most) << name;
    EXPECT_EQ(drawn.Values().front().value, drawn.size) << name;
  }
}

}  // namespace armcal::withheld_effect_test

#include "problems/motion_limits.h"

#include <gtest/gtest.h>

#include <cmath>

namespace armcal::motion_limits_test {

using Eigen::MatrixXd;
using Eigen::Vector2d;

constexpr double kNone = std::numeric_limits<double>::infinity();

struct OneSample {
  Motion motion;
  MatrixXd torque;
};

OneSample At(const Vector2d& q, const Vector2d& qd, const Vector2d& qdd,
             const Vector2d& torque) {
  OneSample at;
  at.motion.q = q.transpose();
  at.motion.qd = qd.transpose();
  at.motion.qdd = qdd.transpose();
  at.torque = torque.transpose();
  return at;
}

MotionLimits Limits() {
  return {Vector2d(-1, 0), Vector2d(3, 2), Vector2d(2, kNone),
          Vector2d(kNone, 5), Vector2d(10, kNone)};
}

TEST(MotionLimits, UsedIsTheLargestShare) {
  const OneSample a = At({2, 1}, {1, 9}, {9, -1}, {3, 99});
  EXPECT_DOUBLE_EQ(Limits().Used(a.motion, a.torque), .5);
  const OneSample b = At({1, 0}, {1, 9}, {9, -1}, {3, 99});
  EXPECT_DOUBLE_EQ(Limits().Used(b.motion, b.torque), 1);
  const OneSample c = At({1, 1}, {1, 9}, {9, -6}, {-11, 99});
  EXPECT_DOUBLE_EQ(Limits().Used(c.motion, c.torque), 1.2);
  EXPECT_DOUBLE_EQ(Limits().Within(.5).Used(a.motion, a.torque), 1);
}

TEST(LimitBarrier, IsTheSumOfLogarithms) {
  const OneSample a = At({2, 1}, {1, 9}, {9, -1}, {3, 99});
  MotionGradient gradient(a.motion);
  MatrixXd of_torque = MatrixXd::Zero(1, 2);
  // Shares of .5, .5, .2 and .3.
  EXPECT_NEAR(
      LimitBarrier(Limits(), a.motion, a.torque, 1, &gradient, &of_torque),
      -2 * std::log(.75) - std::log(.96) - std::log(.91), 1e-14);
}

TEST(LimitBarrier, IsInfiniteBeyond) {
  const OneSample a = At({1, 1}, {2.1, 0}, {0, 0}, {0, 0});
  MotionGradient gradient(a.motion);
  MatrixXd of_torque = MatrixXd::Zero(1, 2);
  EXPECT_EQ(
      LimitBarrier(Limits(), a.motion, a.torque, 1, &gradient, &of_torque),
      kNone);
}

TEST(LimitBarrier, GradientIsItsDerivative) {
  const OneSample a = At({2, .5}, {1, 9}, {9, -3}, {3, 99});
  constexpr double kFactor = .3, h = 1e-6;
  MotionGradient gradient(a.motion);
  MatrixXd of_torque = MatrixXd::Zero(1, 2);
  LimitBarrier(Limits(), a.motion, a.torque, kFactor, &gradient, &of_torque);
  const auto value = [&](const OneSample& at) {
    MotionGradient ignored(at.motion);
    MatrixXd also = MatrixXd::Zero(1, 2);
    return LimitBarrier(Limits(), at.motion, at.torque, kFactor, &ignored,
                        &also);
  };
  const auto derivative = [&](auto part, int j) {
    OneSample plus = a, minus = a;
    part (&plus)(0, j) += h;
    part (&minus)(0, j) -= h;
    return kFactor * (value(plus) - value(minus)) / (2 * h);
  };
  for (int j = 0; j < 2; ++j) {
    const auto q = [](OneSample* at) -> MatrixXd& { return at->motion.q; };
    const auto qd = [](OneSample* at) -> MatrixXd& { return at->motion.qd; };
    const auto qdd = [](OneSample* at) -> MatrixXd& { return at->motion.qdd; };
    const auto tau = [](OneSample* at) -> MatrixXd& { return at->torque; };
    EXPECT_NEAR(gradient.q(0, j), derivative(q, j), 1e-8);
    EXPECT_NEAR(gradient.qd(0, j), derivative(qd, j), 1e-8);
    EXPECT_NEAR(gradient.qdd(0, j), derivative(qdd, j), 1e-8);
    EXPECT_NEAR(of_torque(0, j), derivative(tau, j), 1e-8);
  }
}

}  // namespace armcal::motion_limits_test

#include "model/signals/stiff_step.h"

#include <gtest/gtest.h>

#include <cmath>

namespace armcal::stiff_step_test {

// x' = -k (x - cos t): the solution without its transient.
double Follower(double k, double t) {
  return k * (k * std::cos(t) + std::sin(t)) / (k * k + 1);
}

double FollowerError(double k, double h) {
  StiffStep step(1);
  Eigen::VectorXd x = Eigen::VectorXd::Constant(1, Follower(k, 0));
  const int steps = static_cast<int>(std::lround(2 / h));
  for (int i = 0; i < steps; ++i) {
    step.Advance([&](double t, const double* x,
                     double* rate) { rate[0] = k * (std::cos(t) - x[0]); },
                 i * h, h, &x);
  }
  return std::abs(x[0] - Follower(k, 2));
}

TEST(StiffStep, IsOfSecondOrder) {
  const double coarse = FollowerError(1, .1), fine = FollowerError(1, .05);
  EXPECT_LT(coarse, 1e-3);
  EXPECT_NEAR(coarse / fine, 4, .4);
}

TEST(StiffStep, BearsRatesFarBeyondItsStep) {
  EXPECT_LT(FollowerError(1e6, .1), 1e-5);
}

// A pendulum's energy, and states of different sizes.
TEST(StiffStep, FollowsAnOscillation) {
  StiffStep step(2);
  Eigen::VectorXd x = Eigen::Vector2d(1e-3, 0);
  const double omega = 50, h = 1e-4;
  for (int i = 0; i < 1000; ++i) {
    step.Advance(
        [&](double, const double* x, double* rate) {
          rate[0] = x[1];
          rate[1] = -omega * omega * x[0];
        },
        0, h, &x);
  }
  EXPECT_NEAR(x[0], 1e-3 * std::cos(omega * .1), 1e-7);
  EXPECT_NEAR(x[1], -1e-3 * omega * std::sin(omega * .1), 5e-6);
}

}  // namespace armcal::stiff_step_test

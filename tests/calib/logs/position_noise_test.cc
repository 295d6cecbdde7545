#include "calib/logs/position_noise.h"

#include <gmock/gmock.h>

#include <cmath>

#include "tests/fixtures/sample_motion.h"

namespace armcal::position_noise_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// Motion of up to 2 Hz at 250 Hz, which stands still for its last third.
MatrixXd Motion() {
  MatrixXd q(6000, 1);
  for (int k = 0; k < q.rows(); ++k) {
    const double t = .004 * std::min(k, 4000);
    q(k, 0) = .5 * std::sin(2 * t) + .1 * std::sin(2 * M_PI * 2 * t);
  }
  return q;
}

TEST(PositionNoise, IsThatOfWhiteNoise) {
  std::mt19937_64 random(1);
  MatrixXd q(6000, 2);
  q << Motion(), Motion();
  AddNoise(&random, Eigen::Vector2d(1e-5, 1e-4), &q);
  const VectorXd noise = PositionNoise(q);
  EXPECT_NEAR(noise[0] / 1e-5, 1, .05);
  EXPECT_NEAR(noise[1] / 1e-4, 1, .05);
  EXPECT_NEAR(PositionNoise(q, .1)[0] / 1e-5, 1, .1);
}

// Stamps that jitter by 0.2 ms make up to .4 mrad of a motion of 2 rad/s, but
// nothing where it turns round.
TEST(PositionNoise, OfSlowJointsHasNoJitter) {
  std::mt19937_64 random(4);
  std::normal_distribution<double> jitter(0, 2e-4);
  MatrixXd q(6000, 1);
  for (int k = 0; k < q.rows(); ++k) {
    q(k, 0) = .5 * std::sin(4 * (.004 * k + jitter(random)));
  }
  AddNoise(&random, VectorXd::Constant(1, 1e-5), &q);
  EXPECT_GT(PositionNoise(q)[0], 1e-4);
  EXPECT_LT(PositionNoise(q, .1)[0], 4e-5);
}

// A resolution r is uniform noise of r / sqrt(12) while the joint moves; what
// stands still does not show it.
TEST(PositionNoise, IsThatOfAResolution) {
  const double r = 2e-5;
  const MatrixXd q = (Motion() / r).array().round() * r;
  EXPECT_NEAR(PositionNoise(q)[0] / (r / std::sqrt(12)), 1, .1);
}

// Friction's jerks, steps of the acceleration, are no noise.
TEST(PositionNoise, IsNotMadeByStepsOfAcceleration) {
  std::mt19937_64 random(2);
  MatrixXd q = Motion();
  double position = 0, velocity = 0;
  for (int k = 0; k < q.rows(); ++k) {
    q(k, 0) += position += velocity += k / 200 % 2 ? -2e-5 : 2e-5;
  }
  AddNoise(&random, VectorXd::Constant(1, 1e-6), &q);
  EXPECT_NEAR(PositionNoise(q)[0] / 1e-6, 1, .1);
}

TEST(PositionNoise, IsZeroWhereNothingChanges) {
  EXPECT_EQ(PositionNoise(MatrixXd::Ones(50, 1))[0], 0);
  EXPECT_EQ(PositionNoise(MatrixXd::Ones(1, 1))[0], 0);
}

}  // namespace armcal::position_noise_test

#include "calib/numerics/residual_whiteness.h"

#include <gtest/gtest.h>

#include "tests/fixtures/sample_motion.h"

namespace armcal::residual_whiteness_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// Residuals of 3 joints; the last one's follow each other with `rho`.
MatrixXd Residuals(double rho, std::mt19937_64* random) {
  MatrixXd r = MatrixXd::Zero(5000, 3);
  AddNoise(random, VectorXd::Ones(3), &r);
  for (int k = 1; k < r.rows(); ++k) r(k, 2) += rho * r(k - 1, 2);
  return r;
}

TEST(ResidualWhiteness, AcceptsWhiteNoise) {
  std::mt19937_64 random(1);
  int white = 0;
  for (int run = 0; run < 200; ++run) {
    ResidualWhiteness whiteness(3);
    whiteness.Add(Residuals(0, &random), 50);
    white += whiteness.IsWhite();
    EXPECT_NEAR(whiteness.ratio(), 1, .4);
  }
  EXPECT_GE(white, 195);
}

// Sums over blocks of L samples of an AR(1) process have L (1 + rho) /
// (1 - rho) times its variance for large L.
TEST(ResidualWhiteness, FindsOneJointThatFollowsItself) {
  std::mt19937_64 random(2);
  double worst = 0;
  for (int run = 0; run < 20; ++run) {
    ResidualWhiteness whiteness(3);
    whiteness.Add(Residuals(.6, &random), 50);
    EXPECT_FALSE(whiteness.IsWhite());
    worst += whiteness.worst_ratio() / 20;
  }
  EXPECT_NEAR(worst, 4, .4);
}

TEST(ResidualWhiteness, JointsWithoutSamplesDoNotCount) {
  ResidualWhiteness whiteness(2);
  whiteness.Add(MatrixXd::Zero(1000, 2), 50);
  EXPECT_TRUE(whiteness.IsWhite());
  EXPECT_EQ(whiteness.ratio(), 1);
}

}  // namespace armcal::residual_whiteness_test

#include "calib/diagnose/judge/shown.h"

#include <gtest/gtest.h>

namespace armcal::shown_test {

// Two estimates that are each within their deviation, and opposite: their sum
// is known to .1 and is 1.
TEST(Shown, IsAskedOfAllSizesTogether) {
  const Eigen::Vector2d p(2, -1);
  Eigen::Matrix2d covariance;
  covariance << 9, -9, -9, 9;
  covariance += Eigen::Matrix2d::Identity() * .005;
  EXPECT_TRUE(AreSignificant(p, covariance));
}

// 95 % of chi squared: 3.84 of one degree of freedom, 5.99 of two.
TEST(Shown, BeginsWhereChanceEnds) {
  const auto size = [](double x) { return Eigen::VectorXd::Constant(1, x); };
  const Eigen::MatrixXd one = Eigen::MatrixXd::Identity(1, 1);
  EXPECT_FALSE(AreSignificant(size(1.95), one));
  EXPECT_TRUE(AreSignificant(size(1.97), one));
  const Eigen::MatrixXd two = Eigen::MatrixXd::Identity(2, 2);
  EXPECT_FALSE(AreSignificant(Eigen::Vector2d(2.44, 0), two));
  EXPECT_TRUE(AreSignificant(Eigen::Vector2d(2.45, 0), two));
}

}  // namespace armcal::shown_test

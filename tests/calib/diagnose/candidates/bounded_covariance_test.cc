#include "calib/diagnose/candidates/bounded_covariance.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <random>

#include "tests/fixtures/sample_motion.h"

namespace armcal::bounded_covariance_test {

using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::VectorXd;

// Two correlated parameters p = u, of which the first may not be negative.
struct Pair {
  MatrixXd J = MatrixXd(2, 2);
  std::vector<Coordinate> coordinates = {{0, 0, 1, 1}, {0, 1, 1, 1}};
  Pair() {
    J << 1, .8, 0, .6;
    coordinates[0].low = 0;
  }
  // Where the cost 1/2 |J (u - free)|^2 is least, u_0 >= 0.
  Vector2d Minimum(const Vector2d& free) const {
    if (free[0] >= 0) return free;
    const MatrixXd H = J.transpose() * J;
    return {0, free[1] + H(0, 1) / H(1, 1) * free[0]};
  }
  MatrixXd Covariance(const Vector2d& free) const {
    const Vector2d u = Minimum(free);
    const MatrixXd H = J.transpose() * J;
    return BoundedCovariance(H.inverse(), H * (u - free), coordinates, u);
  }
};

TEST(BoundedCovariance, IsTheInverseInside) {
  const Pair pair;
  const MatrixXd H = pair.J.transpose() * pair.J;
  EXPECT_LT((pair.Covariance({2, 1}) - H.inverse()).norm(), 1e-12);
}

// The mean square about the estimate of all pairs that the cost leaves
// possible: N(free, H^-1) cut at 0, drawn and counted.
TEST(BoundedCovariance, IsThatOfTheDistributionThatTheBoundCuts) {
  const Pair pair;
  const MatrixXd H = pair.J.transpose() * pair.J;
  const MatrixXd root = H.inverse().llt().matrixL();
  std::mt19937_64 random(8);
  for (const double beyond : {1e-9, .5, 1., 2., 3.}) {
    const double sigma = std::sqrt(H.inverse()(0, 0));
    const Vector2d free(-beyond * sigma, .4);
    const Vector2d estimate = pair.Minimum(free);
    double squares = 0;
    int count = 0;
    while (count < 20000) {
      const Vector2d drawn =
          free + root * Vector2d(Normal(&random), Normal(&random));
      if (drawn[0] < 0) continue;
      squares += std::pow(drawn[1] - estimate[1], 2);
      ++count;
    }
    const MatrixXd covariance = pair.Covariance(free);
    EXPECT_NEAR(covariance(1, 1) / (squares / count), 1, .04) << beyond;
    EXPECT_EQ(covariance(0, 0), 0);
    EXPECT_EQ(covariance(0, 1), 0);
  }
}

TEST(BoundedCovariance, OfAKnownValueIsTheConditionalOne) {
  const Pair pair;
  const MatrixXd H = pair.J.transpose() * pair.J;
  EXPECT_NEAR(pair.Covariance({-200, 1})(1, 1), 1 / H(1, 1), 1e-3);
}

}  // namespace armcal::bounded_covariance_test

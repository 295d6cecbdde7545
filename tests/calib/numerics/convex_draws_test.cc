#include "calib/numerics/convex_draws.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace armcal::convex_draws_test {

using Eigen::Matrix2d;
using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::VectorXd;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

LineRange Everywhere(const VectorXd&, const VectorXd&) {
  return {-kInfinity, kInfinity};
}

// x_k >= 0 of all.
LineRange Positive(const VectorXd& at, const VectorXd& along) {
  LineRange range = {-kInfinity, kInfinity};
  for (Eigen::Index k = 0; k < at.size(); ++k) {
    const double end = -at[k] / along[k];
    if (along[k] > 0) range.least = std::max(range.least, end);
    if (along[k] < 0) range.most = std::min(range.most, end);
  }
  return range;
}

// |x_0 - x_1| <= width
struct Strip {
  double width;
  LineRange operator()(const VectorXd& at, const VectorXd& along) const {
    const double here = at[0] - at[1], rate = along[0] - along[1];
    if (rate == 0) return {-kInfinity, kInfinity};
    const double a = (-width - here) / rate, b = (width - here) / rate;
    return {std::min(a, b), std::max(a, b)};
  }
};

MatrixXd Covariance(const MatrixXd& draws) {
  const MatrixXd centred = draws.colwise() - draws.rowwise().mean().eval();
  return centred * centred.transpose() / (draws.cols() - 1);
}

constexpr int kMany = 4000;

// Of n independent draws a mean is known to s / sqrt(n), a variance to
// s^2 sqrt(2 / n); four of these are allowed.
TEST(ConvexDraws, WithoutASetTheyAreOfTheNormalDistribution) {
  const Vector2d mean(1, -2e3);
  Matrix2d covariance;
  covariance << 4, 2.7e3, 2.7e3, 2e6;
  const MatrixXd draws = DrawWithin(mean, covariance, Everywhere, kMany, 1);
  const Vector2d deviation = covariance.diagonal().cwiseSqrt();
  const MatrixXd unit = deviation.cwiseInverse().asDiagonal();
  const VectorXd off = unit * (draws.rowwise().mean() - mean);
  EXPECT_LT(off.cwiseAbs().maxCoeff(), 4 / std::sqrt(kMany));
  const MatrixXd spread = unit * (Covariance(draws) - covariance) * unit;
  EXPECT_LT(spread.cwiseAbs().maxCoeff(), 4 * std::sqrt(2. / kMany));
}

// A half-normal distribution: mean sqrt(2 / pi), variance 1 - 2 / pi.
TEST(ConvexDraws, AHalfSpaceLeavesHalfOfIt) {
  const MatrixXd draws =
      DrawWithin(VectorXd::Zero(1), MatrixXd::Ones(1, 1), Positive, kMany, 1);
  EXPECT_GE(draws.minCoeff(), 0);
  EXPECT_NEAR(draws.mean(), std::sqrt(2 / M_PI), 4 * .6 / std::sqrt(kMany));
  EXPECT_NEAR(Covariance(draws)(0, 0), 1 - 2 / M_PI, .04);
}

// Sheppard: of two of correlation r, a quarter + asin(r) / (2 pi) are positive
// both; the mean of each over these is (1 + r) / (2 sqrt(2 pi)) / that share.
TEST(ConvexDraws, AQuadrantOfTwoCorrelated) {
  const double r = -.8;
  Matrix2d covariance;
  covariance << 1, r, r, 1;
  const MatrixXd draws =
      DrawWithin(Vector2d::Zero(), covariance, Positive, kMany, 1);
  EXPECT_GE(draws.minCoeff(), 0);
  const double share = .25 + std::asin(r) / (2 * M_PI);
  const double mean = (1 + r) / (2 * std::sqrt(2 * M_PI)) / share;
  EXPECT_NEAR(draws.row(0).mean(), mean, .03 * mean);
  EXPECT_NEAR(draws.row(1).mean(), mean, .03 * mean);
}

// The set is a thousandth of the deviation wide across the diagonal: along it
// draws are as independent as anywhere, across it uniform.
TEST(ConvexDraws, ANarrowSetIsWalkedThrough) {
  const double width = 1e-3;
  const MatrixXd draws = DrawWithin(Vector2d::Zero(), Matrix2d::Identity(),
                                    Strip{width}, kMany, 1);
  const VectorXd along = (draws.row(0) + draws.row(1)) / std::sqrt(2.);
  const VectorXd across = draws.row(0) - draws.row(1);
  EXPECT_NEAR(along.mean(), 0, 4 / std::sqrt(kMany));
  EXPECT_NEAR(along.squaredNorm() / kMany, 1, 4 * std::sqrt(2. / kMany));
  double following = 0;
  for (int k = 1; k < kMany; ++k) following += along[k] * along[k - 1] / kMany;
  EXPECT_NEAR(following, 0, 4 / std::sqrt(kMany));
  EXPECT_LE(across.cwiseAbs().maxCoeff(), width);
  EXPECT_NEAR(across.squaredNorm() / kMany / (width * width), 1. / 3, .02);
}

// A peak outside the set, cut off two deviations from it: of the part beyond
// the mean is l = phi(2) / Q(2), the variance 1 + 2 l - l^2 (Johnson, Kotz &
// Balakrishnan 1994), and one of correlation r follows by r l.
TEST(ConvexDraws, OfAPeakOutsideTheSetTheTailIsLeft) {
  constexpr double kLeft = 2.37322, kCorrelation = .8;
  Matrix2d covariance;
  covariance << 1, 100 * kCorrelation, 100 * kCorrelation, 1e4;
  const auto beyond = [](const VectorXd& at, const VectorXd& along) {
    return Positive(at.head(1), along.head(1));
  };
  const MatrixXd draws = DrawWithin(Vector2d(-2, 7), covariance, beyond, kMany,
                                    1, Vector2d(5, -300));
  EXPECT_GE(draws.row(0).minCoeff(), 0);
  EXPECT_NEAR(draws.row(0).mean(), kLeft - 2, .03);
  EXPECT_NEAR(Covariance(draws)(0, 0), 1 + 2 * kLeft - kLeft * kLeft, .015);
  EXPECT_NEAR(draws.row(1).mean(), 7 + 100 * kCorrelation * kLeft, 5);
}

TEST(ConvexDraws, AreTheSameForTheSameSeed) {
  const auto draw = [](uint64_t seed) {
    return DrawWithin(Vector2d::Zero(), Matrix2d::Identity(), Positive, 3,
                      seed);
  };
  EXPECT_EQ(draw(1), draw(1));
  EXPECT_NE(draw(1), draw(2));
}

// Far from the origin of the normal distribution, as rounding leaves it.
TEST(ConvexDraws, AnEndOnTheEstimateIsNoTrap) {
  const MatrixXd draws =
      DrawWithin(Vector2d(0, 1), Matrix2d::Identity(), Positive, 100, 1);
  EXPECT_GT(draws.row(0).maxCoeff(), 1);
}

}  // namespace armcal::convex_draws_test

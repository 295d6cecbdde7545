#include "model/signals/uneven_differences.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace armcal::uneven_differences_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// Every 4 ms, up to 1.5 ms early or late, with rows lost.
VectorXd UnevenTimes(int rows) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> shift(-1.5e-3, 1.5e-3);
  VectorXd t(rows);
  for (int k = 0, at = 0; k < rows; ++k, at += k % 17 == 0 ? 5 : 1) {
    t[k] = .004 * at + shift(random);
  }
  return t;
}

double Polynomial(double t, int degree) { return std::pow(t - .3, degree); }

TEST(DifferentiateUneven, IsExactForPolynomials) {
  const VectorXd t = UnevenTimes(60);
  for (const int points : {3, 5}) {
    for (int degree = 0; degree < points; ++degree) {
      const MatrixXd rate = DifferentiateUneven(
          t, t.unaryExpr([&](double x) { return Polynomial(x, degree); }),
          points);
      for (int k = 0; k < t.size(); ++k) {
        const double expected =
            degree == 0 ? 0 : degree * Polynomial(t[k], degree - 1);
        EXPECT_NEAR(rate(k, 0), expected, 1e-10) << points << " " << degree;
      }
    }
  }
}

TEST(DifferentiateUneven, TakesColumnsApart) {
  const VectorXd t = UnevenTimes(200);
  MatrixXd x(t.size(), 2);
  x << t.array().sin(), (3 * t.array()).cos();
  const MatrixXd rate = DifferentiateUneven(t, x);
  EXPECT_LT((rate.col(0).array() - t.array().cos()).abs().maxCoeff(), 1e-7);
  EXPECT_LT((rate.col(1).array() + 3 * (3 * t.array()).sin()).abs().maxCoeff(),
            1e-5);
}

TEST(DifferentiateUneven, OfFewRows) {
  EXPECT_EQ(DifferentiateUneven(VectorXd::Ones(1), MatrixXd::Ones(1, 2)),
            MatrixXd::Zero(1, 2));
  const MatrixXd rate =
      DifferentiateUneven(Eigen::Vector2d(1, 1.5), Eigen::Vector2d(2, 3));
  EXPECT_NEAR(rate(0, 0), 2, 1e-12);
  EXPECT_NEAR(rate(1, 0), 2, 1e-12);
}

}  // namespace armcal::uneven_differences_test

#include "calib/diagnose/judge/predicted_chi2.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <cmath>
#include <random>
#include <vector>

namespace armcal::predicted_chi2_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// Two joints of 40 and 30 rows; of three columns the first acts on one joint,
// the last on the other, and one on both.
class PredictedChi2Test : public testing::Test {
 protected:
  PredictedChi2Test() : columns_{{{0, 1}, Draw(40, 2)}, {{1, 2}, Draw(30, 2)}} {
    const MatrixXd root = Draw(3, 3);
    covariance_ = root * root.transpose();
    information_ = covariance_.inverse();
  }
  MatrixXd Draw(int rows, int columns) {
    return MatrixXd::NullaryExpr(rows, columns,
                                 [this] { return normal_(random_); });
  }
  // Rows of both joints, all columns.
  MatrixXd All() const {
    MatrixXd X = MatrixXd::Zero(70, 3);
    X.topLeftCorner(40, 2) = columns_[0].values;
    X.bottomRightCorner(30, 2) = columns_[1].values;
    return X;
  }

  std::mt19937_64 random_{3};
  std::normal_distribution<double> normal_;
  std::vector<BaselineColumns> columns_;
  MatrixXd covariance_, information_;
};

TEST_F(PredictedChi2Test, IsThatOfTheWholeCovariance) {
  const PredictedChi2 chi2(columns_, information_);
  const VectorXd r = Draw(70, 1);
  const MatrixXd X = All();
  const MatrixXd S =
      MatrixXd::Identity(70, 70) + X * covariance_ * X.transpose();
  EXPECT_NEAR(chi2.Of({r.head(40), r.tail(30)}), r.dot(S.llt().solve(r)), 1e-9);
}

// Values that are known exactly, some of them, leave the rest as it is.
TEST_F(PredictedChi2Test, OfValuesThatAreKnown) {
  information_.setZero();
  information_.diagonal() << 1e15, 1. / 4, 1e15;
  const PredictedChi2 chi2(columns_, information_);
  const VectorXd r = Draw(70, 1);
  const VectorXd x = All().col(1);
  const double along = x.dot(r);
  EXPECT_NEAR(chi2.Of({r.head(40), r.tail(30)}),
              r.squaredNorm() - along * along / (1. / 4 + x.squaredNorm()),
              1e-9);
}

// Of residuals that are noise and what the fit has wrong: one per row.
TEST_F(PredictedChi2Test, IsOnePerRow) {
  const PredictedChi2 chi2(columns_, information_);
  const MatrixXd root = covariance_.llt().matrixL();
  const MatrixXd X = All();
  constexpr int kDraws = 2000;
  double sum = 0;
  for (int draw = 0; draw < kDraws; ++draw) {
    const VectorXd r = Draw(70, 1) + X * (root * Draw(3, 1));
    sum += chi2.Of({r.head(40), r.tail(30)});
  }
  EXPECT_NEAR(sum / kDraws, 70, 5 * std::sqrt(2 * 70. / kDraws));
}

}  // namespace armcal::predicted_chi2_test

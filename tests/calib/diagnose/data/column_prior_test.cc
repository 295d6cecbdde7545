#include "calib/diagnose/data/column_prior.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <Eigen/QR>
#include <random>

#include "calib/diagnose/data/screen.h"
#include "tests/fixtures/sample_motion.h"

namespace armcal::column_prior_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;

MatrixXd Random(std::mt19937_64* random, int rows, int cols) {
  MatrixXd matrix(rows, cols);
  for (double& value : matrix.reshaped()) value = Normal(random);
  return matrix;
}

// Five columns, of which 1, 3 and 4 are told together.
class ColumnPriorTest : public testing::Test {
 protected:
  ColumnPriorTest() {
    const MatrixXd root = Random(&random_, 3, 3);
    covariance_ =
        .01 * root * root.transpose() + .001 * MatrixXd::Identity(3, 3);
    all_ = MatrixXd::Identity(kSize, kSize);
    all_(which_, which_) = covariance_;
    prior_ = ColumnPrior(which_, covariance_);
    for (const int rows : {12, 9}) {
      rows_.push_back(Random(&random_, rows, kSize));
      target_.push_back(3 * Random(&random_, rows, 1));
    }
    rows_[0].col(4).setZero();  // of the second joint alone
  }
  // Generalised least squares of the rows and N(mean, all_).
  VectorXd Estimate(const VectorXd& mean) const {
    MatrixXd A = all_.inverse();
    VectorXd b = A * mean;
    for (size_t j = 0; j < rows_.size(); ++j) {
      A += rows_[j].transpose() * rows_[j];
      b += rows_[j].transpose() * target_[j];
    }
    return A.fullPivLu().solve(b);
  }
  // Columns that do not act on a joint are none of its.
  std::vector<BaselineColumns> Columns() const {
    std::vector<BaselineColumns> columns = OnEachJoint(rows_);
    columns[0].Remove(4);
    return columns;
  }

  static constexpr int kSize = 5;
  std::mt19937_64 random_{3};
  const std::vector<int> which_ = {1, 3, 4};
  MatrixXd covariance_, all_;
  ColumnPrior prior_;
  std::vector<MatrixXd> rows_;
  JointRows target_;
};

TEST_F(ColumnPriorTest, PrecisionIsTheInverseCovariance) {
  EXPECT_LT((prior_.Precision(kSize) - all_.inverse()).norm(),
            1e-9 * all_.inverse().norm());
  EXPECT_NEAR(prior_.Stddev(3), std::sqrt(covariance_(1, 1)), 1e-15);
  EXPECT_EQ(prior_.Stddev(2), 1);
  const VectorXd x = Random(&random_, kSize, 1);
  EXPECT_NEAR(prior_.Residual(x).squaredNorm(), x.dot(all_.inverse() * x),
              1e-9);
}

// Of x1 and x2, each of variance 1, the sum has 2e-8 and the difference 4: they
// stay as open as they were.
TEST_F(ColumnPriorTest, ASharpSumOfOpenParameters) {
  constexpr double kSharp = 1e-8;
  const Eigen::Matrix2d sharp =
      (Eigen::Matrix2d() << 1, -1 + kSharp, -1 + kSharp, 1).finished();
  const MatrixXd precision = ColumnPrior({0, 1}, sharp).Precision(2);
  const Eigen::Vector2d sum(1, 1), difference(1, -1);
  EXPECT_NEAR(sum.dot(precision * sum) * kSharp, 2, 1e-6);
  EXPECT_NEAR(difference.dot(precision * difference), 1, 1e-6);
}

TEST_F(ColumnPriorTest, AScreenFitsWithinIt) {
  GapScreen screen(Columns(), kSize, target_, prior_);
  screen.Factor();
  const VectorXd x = screen.BaselineGiven(JointRows(2));
  const VectorXd expected = Estimate(VectorXd::Zero(kSize));
  EXPECT_LT((x - expected).norm(), 1e-9 * expected.norm());
  double chi_squared = x.dot(all_.inverse() * x);
  EXPECT_NEAR(screen.PriorCost({}), chi_squared, 1e-9 * chi_squared);
  for (int j = 0; j < 2; ++j) {
    chi_squared += (target_[j] - rows_[j] * x).squaredNorm();
  }
  EXPECT_NEAR(screen.ResidualGiven(JointRows(2)).squaredNorm(), chi_squared,
              1e-9 * chi_squared);
}

// What a reference moved the robot by it does not know anew.
TEST_F(ColumnPriorTest, ItStaysWhereItIsWhenZeroMoves) {
  const VectorXd moved = Random(&random_, kSize, 1);
  prior_.MoveZeroTo(moved);
  VectorXd mean = VectorXd::Zero(kSize);
  mean(which_) = -moved(which_);
  GapScreen screen(Columns(), kSize, target_, prior_);
  screen.Factor();
  const VectorXd expected = Estimate(mean);
  EXPECT_LT((screen.BaselineGiven(JointRows(2)) - expected).norm(),
            1e-9 * expected.norm());
}

}  // namespace armcal::column_prior_test

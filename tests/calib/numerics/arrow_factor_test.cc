#include "calib/numerics/arrow_factor.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <random>

#include "tests/fixtures/sample_motion.h"

namespace armcal::arrow_factor_test {

using Eigen::MatrixXd;

constexpr double kTight = 1e-10;

MatrixXd RandomMatrix(std::mt19937_64* random, int rows, int cols) {
  MatrixXd x(rows, cols);
  for (double& value : x.reshaped()) value = Normal(random);
  return x;
}

// Sum of two squares of columns that two arms do not share, plus one.
class ArrowFactorTest : public testing::Test {
 protected:
  ArrowFactorTest() {
    A_ = MatrixXd::Identity(8, 8);
    for (const std::vector<int>& which :
         {std::vector<int>{0, 3, 5, 6, 2}, std::vector<int>{1, 7, 6, 2, 4}}) {
      const MatrixXd rows = RandomMatrix(&random_, 9, 5);
      A_(which, which) += rows.transpose() * rows;
    }
  }

  std::mt19937_64 random_{7};
  MatrixXd A_;
  const std::vector<std::vector<int>> arms_ = {{0, 3, 5}, {7, 1}};
};

TEST_F(ArrowFactorTest, SolvesAsADenseFactorDoes) {
  const ArrowFactor factor(A_, arms_);
  EXPECT_EQ(factor.common(), (std::vector<int>{2, 4, 6}));
  const MatrixXd b = RandomMatrix(&random_, 8, 3);
  EXPECT_TRUE(factor.Solve(b).isApprox(A_.inverse() * b, kTight));
  EXPECT_NEAR(factor.LogDeterminant(), std::log(A_.determinant()), kTight);
}

TEST_F(ArrowFactorTest, InverseBesideIsAPartOfTheInverse) {
  const ArrowFactor factor(A_, arms_);
  const std::vector<int> which = {7, 1, 2, 4, 6};
  EXPECT_TRUE(factor.InverseBeside(1).isApprox(
      MatrixXd(A_.inverse()(which, which)), kTight));
}

TEST_F(ArrowFactorTest, HalvesHaveTheInverseAsTheirInnerProduct) {
  const ArrowFactor factor(A_, arms_);
  const MatrixXd b = RandomMatrix(&random_, 8, 2);
  MatrixXd common = b(factor.common(), Eigen::all);
  MatrixXd product = MatrixXd::Zero(2, 2);
  for (int k = 0; k < 2; ++k) {
    const MatrixXd half = factor.HalfOfArm(k, b(factor.arm(k), Eigen::all));
    common -= factor.coupling(k).transpose() * half;
    product += half.transpose() * half;
  }
  const MatrixXd half = factor.HalfOfCommon(common);
  product += half.transpose() * half;
  EXPECT_TRUE(product.isApprox(b.transpose() * A_.inverse() * b, kTight));
}

// A matrix without arms, or without anything in common.
TEST_F(ArrowFactorTest, ArmsOrWhatIsCommonMayBeMissing) {
  const MatrixXd b = RandomMatrix(&random_, 8, 1);
  EXPECT_TRUE(ArrowFactor(A_, {}).Solve(b).isApprox(A_.inverse() * b, kTight));
  const MatrixXd diagonal = A_.diagonal().asDiagonal();
  const ArrowFactor alone(diagonal, {{0, 1, 2, 3}, {4, 5, 6, 7}});
  EXPECT_TRUE(alone.Solve(b).isApprox(diagonal.inverse() * b, kTight));
}

}  // namespace armcal::arrow_factor_test

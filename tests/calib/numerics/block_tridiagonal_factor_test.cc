#include "calib/numerics/block_tridiagonal_factor.h"

#include <gtest/gtest.h>

#include <Eigen/LU>

#include "tests/fixtures/sample_robots.h"

namespace armcal::block_tridiagonal_factor_test {

using Eigen::MatrixXd;
using Blocks = BlockTridiagonalFactor::Blocks;

// Squares of width 4 along the diagonal, as blocks of 3 and as a whole.
class Chain : public testing::Test {
 protected:
  Chain() : blocks_(5, 3), dense_(MatrixXd::Zero(15, 15)) {
    std::mt19937_64 random(3);
    for (int begin = 0; begin + 4 <= 15; ++begin) {
      const MatrixXd A = UniformVector(&random, 24, -1, 1).reshaped(4, 6);
      const MatrixXd square = A * A.transpose();
      blocks_.Add(begin, square);
      dense_.block(begin, begin, 4, 4) += square;
    }
    right_ = UniformVector(&random, 30, -1, 1).reshaped(15, 2);
  }
  Blocks blocks_;
  MatrixXd dense_, right_;
};

TEST_F(Chain, SquaresLandWhereTheyBelong) {
  for (int begin = 0; begin + 4 <= 15; ++begin) {
    EXPECT_EQ(blocks_.Square(begin, 4), dense_.block(begin, begin, 4, 4));
  }
}

TEST_F(Chain, SolvesAndInverts) {
  const BlockTridiagonalFactor factor(blocks_);
  ASSERT_TRUE(factor.positive());
  const MatrixXd inverse = dense_.inverse();
  EXPECT_LT((factor.Solve(right_) - inverse * right_).norm(), 1e-9);
  const Blocks part = factor.Inverse();
  for (int begin = 0; begin + 4 <= 15; ++begin) {
    EXPECT_LT(
        (part.Square(begin, 4) - inverse.block(begin, begin, 4, 4)).norm(),
        1e-9);
  }
}

TEST_F(Chain, SaysWhatIsNotPositive) {
  MatrixXd square = MatrixXd::Zero(4, 4);
  square(2, 2) = -50;
  blocks_.Add(7, square);
  EXPECT_FALSE(BlockTridiagonalFactor(blocks_).positive());
}

}  // namespace armcal::block_tridiagonal_factor_test

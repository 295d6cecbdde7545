#include "calib/diagnose/data/inner_products.h"

#include <gtest/gtest.h>

#include <random>

namespace armcal::inner_products_test {

using Eigen::MatrixXd;

// Of more columns than are worked out at a time; the rows are no whole groups.
class InnerProductsTest : public testing::Test {
 protected:
  MatrixXd Draw(int rows, int columns) {
    std::normal_distribution<double> normal;
    return MatrixXd::NullaryExpr(rows, columns,
                                 [&] { return normal(random_); });
  }
  std::mt19937_64 random_{3};
};

TEST_F(InnerProductsTest, AreThoseOfPlainSums) {
  const MatrixXd a = Draw(77, 12), b = Draw(77, 7);
  EXPECT_TRUE(InnerProducts(a, b).isApprox(a.transpose() * b, 1e-13));
}

// The same bits as if each were worked out from its own side.
TEST_F(InnerProductsTest, WithLastAreTheSameFromEitherSide) {
  const MatrixXd a = Draw(77, 260);
  for (const int count : {0, 1, 96, 101, 203, 260}) {
    EXPECT_EQ(InnerProductsWithLast(a, count),
              InnerProducts(a, a.rightCols(count)))
        << count;
  }
}

}  // namespace armcal::inner_products_test

#include "model/signals/column_basis.h"

#include <gtest/gtest.h>

#include <cmath>

namespace armcal::column_basis_test {

using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::VectorXd;

TEST(ColumnBasis, KeepsTheFirstOfDependentColumns) {
  ColumnBasis basis(3);
  EXPECT_TRUE(basis.Add(Vector3d(1, 2, 0), 1));
  EXPECT_FALSE(basis.Add(Vector3d(-2, -4, 0), 1));
  EXPECT_TRUE(basis.Add(Vector3d(0, 1, 0), 1));
  EXPECT_FALSE(basis.Add(Vector3d(5, -7, 0), 1));
  EXPECT_FALSE(basis.Add(Vector3d(0, 0, 0), 1));
  EXPECT_TRUE(basis.Add(Vector3d(3, 3, 1e-3), 1));
  EXPECT_FALSE(basis.Add(Vector3d(8, 1, 4), 1));  // the space is full
}

TEST(ColumnBasis, JudgesByScaleAndTolerance) {
  const Vector3d x(1, 0, 0), almost(1, 1e-6, 0);
  const auto adds = [&](double scale, double tolerance) {
    ColumnBasis basis(3);
    basis.Add(x, 1);
    return basis.Add(almost, scale, tolerance);
  };
  EXPECT_TRUE(adds(1, 1e-8));
  EXPECT_FALSE(adds(1, 1e-5));
  EXPECT_FALSE(adds(1e3, 1e-8));
  EXPECT_TRUE(adds(1e-3, 1e-5));
}

// Läuchli's columns, on which one pass of Gram-Schmidt loses orthogonality.
TEST(ColumnBasis, StaysOrthogonalOnNearlyDependentColumns) {
  const double e = 1e-7;
  ColumnBasis basis(4);
  EXPECT_TRUE(basis.Add(Eigen::Vector4d(1, e, 0, 0), 1));
  EXPECT_TRUE(basis.Add(Eigen::Vector4d(1, 0, e, 0), 1));
  EXPECT_TRUE(basis.Add(Eigen::Vector4d(1, 0, 0, e), 1));
  // In the span of the three: (0, e, -e, 0) and their mean.
  EXPECT_FALSE(basis.Add(Eigen::Vector4d(0, 1, -1, 0), 1));
  EXPECT_FALSE(basis.Add(Eigen::Vector4d(3, e, e, e), 1));
  EXPECT_TRUE(basis.Add(Eigen::Vector4d(1, 0, 0, 0), 1));
}

TEST(ColumnBasis, FindsTheRankOfHilbertLikeProducts) {
  // Columns of degree-3 polynomials at 9 points span 4 dimensions.
  ColumnBasis basis(9);
  int rank = 0;
  for (int c = 0; c < 12; ++c) {
    VectorXd column(9);
    for (int k = 0; k < 9; ++k) {
      const double x = .25 * k - 1;
      column[k] = std::pow(x - .3 * c, 3);
    }
    rank += basis.Add(column, column.norm());
  }
  EXPECT_EQ(rank, 4);
}

TEST(ExpressInColumns, FindsCoefficients) {
  MatrixXd A(4, 4);
  A << 1, 0, 2, 7,  //
      1, 1, 2, -1,  //
      0, 1, 0, -8,  //
      2, 0, 4, 14;
  // Column 3 is 7 times column 0 less 8 times column 1.
  EXPECT_LT((ExpressInColumns(A, 3, {0, 1}) - Vector2d(7, -8)).norm(), 1e-13);
  EXPECT_LT((ExpressInColumns(A, 3, {1, 0}) - Vector2d(-8, 7)).norm(), 1e-13);
  const VectorXd c = ExpressInColumns(A, 2, {0, 1});
  EXPECT_NEAR(c[0], 2, 1e-14);
  EXPECT_EQ(c[1], 0);  // not 1e-17
  EXPECT_EQ(ExpressInColumns(A, 2, {}).size(), 0);
}

// Elsewhere the least-squares solution: the projection.
TEST(ExpressInColumns, ProjectsOtherColumns) {
  MatrixXd A(3, 3);
  A << 1, 0, 3, 0, 2, 4, 0, 0, 5;
  EXPECT_LT((ExpressInColumns(A, 2, {0, 1}) - Vector2d(3, 2)).norm(), 1e-14);
}

}  // namespace armcal::column_basis_test

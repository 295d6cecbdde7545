#include <gtest/gtest.h>

#include <Eigen/QR>
#include <cmath>
#include <random>
#include <string>

#include "model/simd/kernels.h"
#include "tests/fixtures/sample_motion.h"
#include "tests/fixtures/sample_robots.h"

namespace armcal::householder_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;

MatrixXd RandomMatrix(int rows, int columns, std::mt19937_64* random) {
  MatrixXd A(rows, columns);
  for (double& x : A.reshaped()) x = Normal(random);
  return A;
}

// Rows of a positive diagonal, as R is unique with.
MatrixXd WithPositiveDiagonal(MatrixXd R) {
  for (int k = 0; k < R.rows(); ++k) {
    if (R(k, k) < 0) R.row(k) *= -1;
  }
  return R;
}

MatrixXd EigenFactor(const MatrixXd& A) {
  const Eigen::HouseholderQR<MatrixXd> qr(A);
  const MatrixXd R = qr.matrixQR().topRows(A.cols());
  return WithPositiveDiagonal(R.triangularView<Eigen::Upper>());
}

// Every instruction set of this processor.
class Householder : public testing::TestWithParam<const simd::Kernels*> {
 protected:
  // Adds A's rows to R.
  static void Add(MatrixXd A, bool triangular, MatrixXd* R) {
    const int n = static_cast<int>(A.cols());
    GetParam()->householder(R->data(), n, n, A.data(), A.rows(), A.rows(),
                            triangular);
  }
  std::mt19937_64 random_{7};
};

INSTANTIATE_TEST_SUITE_P(Sets, Householder,
                         testing::ValuesIn(simd::AvailableKernels()),
                         [](const auto& info) {
                           return std::string(info.param->instruction_set);
                         });

TEST_P(Householder, FactorsChunksLikeEigenTheWhole) {
  for (const int columns : {1, 2, 7, 8, 9, 16, 17, 20, 61}) {
    const MatrixXd A = RandomMatrix(400, columns, &random_);
    MatrixXd R = MatrixXd::Zero(columns, columns);
    Add(A.topRows(8), false, &R);
    Add(A.middleRows(8, 256), false, &R);
    Add(A.bottomRows(136), false, &R);
    EXPECT_TRUE(R.isUpperTriangular(0));
    EXPECT_LT((WithPositiveDiagonal(R) - EigenFactor(A)).norm(),
              1e-13 * A.norm())
        << columns;
  }
}

TEST_P(Householder, FactorsTriangles) {
  for (const int columns : {1, 5, 8, 13, 33}) {
    const MatrixXd A = RandomMatrix(200, columns, &random_);
    MatrixXd R = EigenFactor(A.topRows(100));
    MatrixXd below = MatrixXd::Zero((columns + 7) / 8 * 8, columns);
    below.topRows(columns) = EigenFactor(A.bottomRows(100));
    Add(below, true, &R);
    EXPECT_LT((WithPositiveDiagonal(R) - EigenFactor(A)).norm(),
              1e-13 * A.norm())
        << columns;
  }
}

// Each column's error is relative to itself, whatever the others' sizes.
TEST_P(Householder, KeepsColumnsOfAnySize) {
  const int columns = 12;
  const MatrixXd A = RandomMatrix(256, columns, &random_);
  const VectorXd size = VectorXd::LinSpaced(columns, -120, 120)
                            .unaryExpr([](double e) { return pow(10, e); })
                            .reverse();
  MatrixXd R = MatrixXd::Zero(columns, columns);
  Add(A * size.asDiagonal(), false, &R);
  const MatrixXd scaled = R * size.cwiseInverse().asDiagonal();
  EXPECT_LT((WithPositiveDiagonal(scaled) - EigenFactor(A)).norm(),
            1e-12 * A.norm());
}

// Columns that depend on others leave rounding on the diagonal: |a| * 1e-16,
// where normal equations leave |a| * 1e-8.
TEST_P(Householder, SeesRank) {
  MatrixXd A = RandomMatrix(256, 20, &random_);
  A.col(9) = A.col(8) + 1e-10 * A.col(9);
  A.col(11).setZero();
  A.col(19) = A.col(1) - 3 * A.col(2);
  MatrixXd R = MatrixXd::Zero(20, 20);
  Add(A, false, &R);
  EXPECT_NEAR(std::abs(R(9, 9)) / EigenFactor(A)(9, 9), 1, 1e-4);
  EXPECT_EQ(R.col(11).norm(), 0);
  EXPECT_LT(std::abs(R(19, 19)), 1e-13 * A.col(19).norm());
  EXPECT_LT((R.transpose() * R - A.transpose() * A).norm(),
            1e-13 * A.squaredNorm());
}

TEST_P(Householder, PassesNotANumberOn) {
  MatrixXd A = RandomMatrix(8, 3, &random_), R = MatrixXd::Zero(3, 3);
  A(4, 1) = std::nan("");
  Add(A, false, &R);
  EXPECT_TRUE(std::isnan(R(1, 1)));
}

TEST_P(Householder, InnerProductsAreEigens) {
  for (const int a : {1, 3, 4, 5, 8, 13}) {
    for (const int b : {1, 2, 3, 7}) {
      const MatrixXd A = RandomMatrix(72, a, &random_);
      const MatrixXd B = RandomMatrix(80, b, &random_);
      MatrixXd products(a, b);
      GetParam()->inner_products(A.data(), 72, a, B.data(), 80, b, 72,
                                 products.data());
      EXPECT_LT((products - A.transpose() * B.topRows(72)).norm(), 1e-12);
    }
  }
}

}  // namespace armcal::householder_test

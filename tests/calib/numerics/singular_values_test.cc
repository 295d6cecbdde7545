#include "calib/numerics/singular_values.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace armcal::singular_values_test {

using Eigen::MatrixXd;

// Columns of all sizes, some 0, some alike, of few rows: what is left of the
// equations of an arm that hardly moved. Of some of these Eigen's divide and
// conquer makes NaN or vectors of length 0.
MatrixXd Graded(int rows, int columns, std::mt19937_64* random) {
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> exponent(-19, 9);
  MatrixXd A = MatrixXd::Zero(rows, columns);
  for (int c = 0; c < columns; ++c) {
    const double size = std::pow(10, exponent(*random));
    if ((*random)() % 3 == 0) continue;
    for (double& x : A.col(c)) x = size * normal(*random);
    if (c > 0 && (*random)() % 4 == 0) A.col(c) = A.col(c - 1);
  }
  return A.triangularView<Eigen::Upper>();
}

TEST(SingularValues, DecomposesWhatIsGraded) {
  std::mt19937_64 random(1);
  for (int draw = 0; draw < 400; ++draw) {
    const int columns = 20 + draw % 50, rows = 10 + draw % 60;
    const MatrixXd A = Graded(rows, columns, &random);
    const SingularValues svd = DecomposeSingular(A);
    const auto distance = [](const MatrixXd& X) {
      return (X.transpose() * X - MatrixXd::Identity(X.cols(), X.cols()))
          .norm();
    };
    ASSERT_LT(distance(svd.U), 1e-10) << draw;
    ASSERT_LT(distance(svd.V), 1e-10) << draw;
    const auto rank = svd.s.size();
    ASSERT_LE(
        (svd.U * svd.s.asDiagonal() * svd.V.leftCols(rank).transpose() - A)
            .norm(),
        1e-12 * A.norm())
        << draw;
  }
}

}  // namespace armcal::singular_values_test

#include "calib/numerics/posterior.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include "tests/fixtures/sample_motion.h"

namespace armcal::posterior_test {

using Eigen::MatrixXd;

MatrixXd RandomRows(int size, int rows, std::mt19937_64* random) {
  MatrixXd A(rows, size);
  for (double& x : A.reshaped()) x = Normal(random);
  return A;
}

MatrixXd RandomInformation(int size, int rank, std::mt19937_64* random) {
  const MatrixXd A = RandomRows(size, rank, random);
  return A.transpose() * A;
}

TEST(Posterior, IsTheInverseOfTheSum) {
  std::mt19937_64 random(1);
  const MatrixXd A = RandomRows(6, 4, &random);
  const MatrixXd data = A.transpose() * A;
  const MatrixXd prior = RandomInformation(6, 9, &random);
  const MatrixXd scores = RandomInformation(6, 3, &random);
  const Posterior posterior(A, prior, {0, 1, 3, 5});
  const std::vector<int> kept = {0, 1, 3, 5};
  const MatrixXd inverse = MatrixXd((data + prior)(kept, kept)).inverse();
  EXPECT_LT((posterior.Gain()(kept, kept) - inverse).norm(),
            1e-12 * inverse.norm());
  EXPECT_EQ(posterior.Gain().row(2).norm() + posterior.Gain().col(4).norm(), 0);
  const MatrixXd sandwich = inverse * scores(kept, kept) * inverse;
  EXPECT_LT(
      (posterior.Sandwich(SquareRoot(scores))(kept, kept) - sandwich).norm(),
      1e-12 * sandwich.norm());
}

// Data of noise 1e-10 on two of three combinations: the third has the prior's
// variance, which a direct inverse loses.
TEST(Posterior, KeepsWhatOnlyThePriorKnows) {
  MatrixXd J(2, 3);
  J << 1, 1, 1, 1, 2, 3;
  J *= 1e10;
  const MatrixXd prior = MatrixXd::Identity(3, 3);
  const Posterior posterior(J, prior, {0, 1, 2});
  const Eigen::Vector3d unseen = Eigen::Vector3d(1, -2, 1).normalized();
  EXPECT_NEAR(unseen.dot(posterior.Gain() * unseen), 1, 1e-6);
  EXPECT_NEAR(posterior.Gain().trace(), 1, 1e-6);
}

TEST(Posterior, ParametersWithoutPriorHaveTheDatas) {
  std::mt19937_64 random(2);
  const MatrixXd A = RandomRows(3, 8, &random);
  const MatrixXd data = A.transpose() * A;
  const Posterior posterior(A, MatrixXd::Zero(3, 3), {0, 1, 2});
  EXPECT_LT((posterior.Gain() - data.inverse()).norm(),
            1e-6 * data.inverse().norm());
}

// G is a hundred million times larger in directions that A does not have: as
// written the product is neither symmetric nor free of negative variances.
TEST(Sandwich, IsACovarianceWhateverCancels) {
  std::mt19937_64 random(4);
  const MatrixXd A = RandomInformation(6, 3, &random);
  const MatrixXd null =
      Eigen::FullPivLU<MatrixXd>(A).setThreshold(1e-9).kernel();
  ASSERT_EQ(null.cols(), 3);
  const MatrixXd G = RandomRows(6, 6, &random) +
                     1e8 * RandomRows(3, 6, &random) * null.transpose();
  const auto correlations = [](const MatrixXd& C) {
    const Eigen::VectorXd s =
        C.diagonal().cwiseAbs().cwiseSqrt().cwiseInverse();
    return MatrixXd(s.asDiagonal() * C * s.asDiagonal());
  };
  const MatrixXd C = correlations(Sandwich(G, A));
  EXPECT_LT((C - C.transpose()).norm(), 1e-14);
  EXPECT_GT(Eigen::SelfAdjointEigenSolver<MatrixXd>(C).eigenvalues()[0],
            -1e-14);
  const MatrixXd written = correlations(G * A * G.transpose());
  EXPECT_GT((written - written.transpose()).norm(), 1e-6);
}

}  // namespace armcal::posterior_test

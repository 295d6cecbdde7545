#include "calib/watch/information.h"

#include <gmock/gmock.h>

#include <Eigen/Cholesky>

#include "tests/fixtures/sample_motion.h"

namespace armcal::information_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kParameters = 4, kColumns = 6, kRows = 30;

MatrixXd Draw(std::mt19937_64* random, int rows, int columns) {
  MatrixXd x(rows, columns);
  for (double& value : x.reshaped()) value = Normal(random);
  return x;
}

struct Case {
  explicit Case(int seed) {
    std::mt19937_64 random(seed);
    A = Draw(&random, kRows, kColumns);
    r = 2 * Draw(&random, kRows, 1);
    weight = Draw(&random, kRows, 1).cwiseAbs2().array() + .1;
    const MatrixXd half = Draw(&random, kParameters, 2);  // singular
    belief = {Draw(&random, kParameters, 1), half * half.transpose()};
    change.columns = Draw(&random, kColumns, 2);
    change.stddev = Eigen::Vector2d(.7, 2);
    rows.Add(A, r, weight);
  }
  MatrixXd A;
  VectorXd r, weight;
  ParameterBelief belief;
  WatchHypothesis change;
  RowInformation rows{kColumns};
};

// log of the normal density of r, whose covariance holds noise, what is not
// known of the parameters, and the change: the definition, as it stands.
double LogDensity(const Case& c, const MatrixXd& extra) {
  const MatrixXd U = c.A.leftCols(kParameters);
  MatrixXd covariance = U * c.belief.covariance * U.transpose() + extra;
  covariance.diagonal() += c.weight.cwiseInverse();
  const Eigen::LLT<MatrixXd> factor(covariance);
  const VectorXd left = c.r - U * c.belief.mean;
  return -left.dot(factor.solve(left)) / 2 -
         MatrixXd(factor.matrixL()).diagonal().array().log().sum();
}

TEST(Information, BayesFactorIsThatOfTheDensities) {
  for (int seed = 0; seed < 5; ++seed) {
    const Case c(seed);
    const MatrixXd AB = c.A * c.change.columns * c.change.stddev.asDiagonal();
    const double expected = LogDensity(c, AB * AB.transpose()) -
                            LogDensity(c, MatrixXd::Zero(kRows, kRows));
    const ChangeTest test(c.rows, c.belief,
                          CovarianceRoot(c.belief.covariance));
    EXPECT_NEAR(test.Of(c.change).log_bayes, expected,
                1e-8 * std::abs(expected) + 1e-8);
  }
}

// With nothing unknown about the parameters: the squares that are explained.
TEST(Information, LikelihoodIsThatOfTheEstimate) {
  Case c(3);
  c.belief.covariance.setZero();
  const ChangeEvidence found =
      ChangeTest(c.rows, c.belief, MatrixXd::Zero(kParameters, 1)).Of(c.change);
  const VectorXd before = c.r - c.A.leftCols(kParameters) * c.belief.mean;
  const VectorXd after = before - c.A * (c.change.columns * found.theta);
  EXPECT_NEAR(found.log_likelihood,
              (before.cwiseAbs2() - after.cwiseAbs2()).dot(c.weight) / 2, 1e-9);
}

// The conditional normal distribution, by its textbook formula.
TEST(Information, BeliefIsTheConditionalDistribution) {
  const Case c(7);
  const MatrixXd U = c.A.leftCols(kParameters);
  MatrixXd innovation = U * c.belief.covariance * U.transpose();
  innovation.diagonal() += c.weight.cwiseInverse();
  const MatrixXd gain =
      c.belief.covariance * U.transpose() *
      innovation.llt().solve(MatrixXd::Identity(kRows, kRows));
  const VectorXd mean = c.belief.mean + gain * (c.r - U * c.belief.mean);
  const MatrixXd covariance =
      c.belief.covariance - gain * U * c.belief.covariance;
  const ParameterBelief after = Updated(c.belief, c.rows);
  EXPECT_LT((after.mean - mean).norm(), 1e-9);
  EXPECT_LT((after.covariance - covariance).norm(), 1e-9);
}

}  // namespace armcal::information_test

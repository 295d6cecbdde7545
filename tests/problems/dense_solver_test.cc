#include "problems/dense_solver.h"

#include <ceres/normal_prior.h>
#include <gtest/gtest.h>

namespace armcal::dense_solver_test {

// Data tell x + y a million times better than the prior tells x and y apart,
// and do not agree among themselves: what the prior can gain is nothing beside
// their cost. Still the answer is x = y.
TEST(SolveDense, FollowsDirectionsThatOnlyThePriorKnows) {
  Eigen::VectorXd x = Eigen::Vector2d(1, 0);
  Eigen::MatrixXd sum(1, 2);
  sum << 1e6, 1e6;
  ceres::Problem problem;
  for (const double seen : {.99, 1.01}) {
    problem.AddResidualBlock(
        new ceres::NormalPrior(sum, Eigen::VectorXd(Eigen::Vector2d(seen, 0))),
        nullptr, x.data());
  }
  problem.AddResidualBlock(
      new ceres::NormalPrior(Eigen::MatrixXd::Identity(2, 2),
                             Eigen::VectorXd(Eigen::Vector2d::Zero())),
      nullptr, x.data());
  const auto summary = SolveDense(1e-9, &problem);
  EXPECT_EQ(summary.termination_type, ceres::CONVERGENCE);
  EXPECT_NEAR(x[0], .5, 1e-3);
  EXPECT_NEAR(x[1], .5, 1e-3);
}

}  // namespace armcal::dense_solver_test

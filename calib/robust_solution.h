#pragma once

#include <Eigen/Core>
#include <vector>

#include "calib/identifiability.h"
#include "calib/linear_solution.h"
#include "calib/residual_pass.h"

namespace armcal {

struct RobustSolution {
  LinearSolution solution;
  Eigen::VectorXd noise;       // per joint, robust
  std::vector<long> outliers;  // per joint, equations weighed below 1/2
};

// Iteratively reweighted least squares with Huber's loss in two passes over the
// logs from a solution `x` with `noise`: each weighs the rows by the solution
// before it and sets the joints' noise to the robust spread of their residuals,
// but for `frozen` joints.
RobustSolution SolveRobust(const Eigen::VectorXd& x,
                           const Eigen::VectorXd& noise,
                           const std::vector<bool>& frozen,
                           const ReferenceMotion& reference,
                           ResidualPass* pass);

}  // namespace armcal

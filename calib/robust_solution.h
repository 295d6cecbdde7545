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

// Iteratively reweighted least squares with Huber's loss from a solution `x`
// with `noise`: each pass over the logs weighs the rows by the solution before
// it and sets the joints' noise to the robust spread of their residuals (at
// least a thousandth of `noise`), but for `frozen` joints. It ends when no
// parameter moves by more than a tenth of its standard deviation; two or three
// passes on clean logs, 20 at most.
RobustSolution SolveRobust(const Eigen::VectorXd& x,
                           const Eigen::VectorXd& noise,
                           const std::vector<bool>& frozen,
                           const ReferenceMotion& reference,
                           ResidualPass* pass);

}  // namespace armcal

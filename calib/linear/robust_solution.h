#pragma once

#include <Eigen/Core>
#include <vector>

#include "calib/linear/identifiability.h"
#include "calib/linear/residual_pass.h"
#include "calib/linear/solution.h"
#include "problems/robust_loss.h"

namespace armcal {

struct RobustSolution {
  LinearSolution solution;
  Eigen::VectorXd noise;       // per joint, robust
  std::vector<long> outliers;  // per joint, equations weighed below 1/2
};

// Iteratively reweighted least squares with `loss` from a solution `x` with
// `noise` (a loss that gives residuals up, from Huber's solution): each pass
// over the logs weighs the rows by the solution before it and sets the joints'
// noise to the robust spread of their residuals (at least a thousandth of
// `noise`), but for `frozen` joints. It ends when no parameter moves by more
// than a tenth of its standard deviation; two or three passes on clean logs, 20
// at most for each loss.
RobustSolution SolveRobust(const Eigen::VectorXd& x,
                           const Eigen::VectorXd& noise,
                           const std::vector<bool>& frozen, RobustLoss loss,
                           const ReferenceScale& reference, ResidualPass* pass);

}  // namespace armcal

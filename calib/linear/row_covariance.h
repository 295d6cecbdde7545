#pragma once

#include <Eigen/Core>
#include <string>

#include "calib/linear/identifiability.h"
#include "calib/linear/residual_pass.h"
#include "calib/linear/solution.h"
#include "problems/robust_loss.h"

namespace armcal {

struct CovarianceEstimate {
  Eigen::MatrixXd covariance;  // p x p, of the wanted parameters
  std::string method;          // a phrase for reports
  int window = 1;              // of the scores, in rows
  int rows_per_window = 1;     // as given
};

// Deviations of `covariance` raised to the scatter of the logs' score sums
// (columns), which `gain` takes to parameters; as it is with less than three.
Eigen::MatrixXd RaiseToLogScatter(const Eigen::MatrixXd& covariance,
                                  const Eigen::MatrixXd& gain,
                                  const Eigen::MatrixXd& log_sums);

// The covariance of a solution from rows that overlap and whose errors are
// autocorrelated: the sandwich of the solution's gain and the long-run
// covariance of the scores (Newey-West over Andrews' window for what rows that
// do not overlap, `rows_per_window` apart, still share, of the worst joint).
// Deviations are at least what errors that are correlated only where rows
// overlap make of them, and with three logs or more at least what the scatter
// of the logs' score sums shows: something may change from log to log
// (temperature, wear, a torque scale). `loss`: that of the solution; `wanted`:
// p x m, takes the solution's m parameters to those of interest. Two passes
// over the logs.
CovarianceEstimate EstimateRowCovariance(const LinearSolution& solution,
                                         const Eigen::VectorXd& noise,
                                         RobustLoss loss,
                                         const ReferenceScale& reference,
                                         const Eigen::MatrixXd& wanted,
                                         long rows, int rows_per_window,
                                         ResidualPass* pass);

}  // namespace armcal

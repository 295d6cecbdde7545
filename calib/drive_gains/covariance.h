#pragma once

#include <Eigen/Core>

#include "calib/drive_gains/current_pass.h"
#include "calib/drive_gains/fit.h"
#include "calib/linear/row_covariance.h"

namespace armcal {

// The covariance of quantities with gradients D by (g, x, p), p x k, at the
// minimum: k x k. As EstimateRowCovariance has it for linear estimates: rows
// overlap and their errors are autocorrelated. `rows_per_window` are known to
// overlap; `loss`: what the estimate minimises. Two passes over the
// logs.
CovarianceEstimate EstimateGainCovariance(const GainFit& fit, RobustLoss loss,
                                          const Eigen::MatrixXd& D,
                                          int rows_per_window,
                                          CurrentPass* pass);

}  // namespace armcal

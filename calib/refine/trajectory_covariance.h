#pragma once

#include <Eigen/Core>
#include <optional>

#include "calib/linear/row_covariance.h"
#include "calib/refine/trajectory_pass.h"

namespace armcal {

// The inverse of an information matrix within the directions (columns) of
// `seen`; the others have none. Nothing where rounding leaves it no inverse, as
// with torques far more exact than the positions let them be predicted.
std::optional<Eigen::MatrixXd> InverseWithin(
    const Eigen::MatrixXd& seen, const Eigen::MatrixXd& information);

struct TrajectoryCovariance {
  CovarianceEstimate estimate;  // of x, with widths uncertain
  Eigen::MatrixXd independent;  // had all samples independent errors
  double inflation = 1;         // of standard deviations, median
};

// The covariance of a refinement that has settled. Where torque residuals are
// white (ResidualWhiteness) it is that of independent samples; where they are
// not, deviations are at least those by the scores' long-run covariance
// (Newey-West, Andrews' window, at least `least_window_s`). One or two passes.
// Nothing where InverseWithin() has none.
std::optional<TrajectoryCovariance> EstimateTrajectoryCovariance(
    const TrajectoryEstimate& estimate, const Eigen::MatrixXd& seen,
    double least_window_s, TrajectoryPass* pass);

}  // namespace armcal

#pragma once

#include <Eigen/Core>
#include <vector>

#include "calib/diagnose/candidates/block_covariance.h"

namespace armcal {

// Which joint each row is of, as residuals have them.
std::vector<int> JointsOfRows(const GapRows& rows);

// The covariance of a least-squares estimate, widened for parameters `which`
// that all joints have in common, such as a delay of the whole robot: by how
// much its joints disagree. The variance of such a parameter is at least that
// by BlockCovariance of its own slopes (less what the other parameters' slopes
// explain of them), the blocks being the joints: where all had the same value
// their scores would be noise. J: residual by parameter; rows beyond the
// joints' are of a prior and of other data. One joint says nothing.
Eigen::MatrixXd WidenByJoints(const Eigen::MatrixXd& covariance,
                              const RowMajorMatrix& J,
                              const Eigen::VectorXd& residual,
                              const std::vector<int>& joint_of_row,
                              const std::vector<int>& which);

}  // namespace armcal

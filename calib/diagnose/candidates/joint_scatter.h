#pragma once

#include <Eigen/Core>
#include <vector>

#include "calib/diagnose/candidates/block_covariance.h"

namespace armcal {

// The covariance of a least-squares estimate, widened for parameters `which`
// that all joints have in common, such as a delay of the whole robot: by how
// much its joints disagree. With the slopes a of one such parameter, less what
// the other parameters' slopes explain of them, and each joint's score s_j =
// sum of a_i r_i over its rows, its variance is at least
//   n / (n - 1) sum_j s_j^2 / (a' a)^2
// of n joints whose rows depend on it (Liang and Zeger 1986, clusters being the
// joints). Where all had the same value the scores would be noise. J: residual
// by parameter, joint by joint; `rows_of_joint`: how many each has; more rows
// are of a prior and of other data. One joint says nothing.
Eigen::MatrixXd WidenByJoints(const Eigen::MatrixXd& covariance,
                              const RowMajorMatrix& J,
                              const Eigen::VectorXd& residual,
                              const std::vector<int>& rows_of_joint,
                              const std::vector<int>& which);

}  // namespace armcal

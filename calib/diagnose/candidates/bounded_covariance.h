#pragma once

#include <Eigen/Core>
#include <vector>

#include "calib/diagnose/candidates/coordinates.h"

namespace armcal {

// The covariance of parameters, in their own units, at the minimum u of a cost
// within the coordinates' bounds: that of the coordinates as if there were no
// bounds, times their slopes on both sides (the delta method). `gradient`: of
// the cost by coordinate. Parameters at a bound have no variance; what the
// others owe to one at a bound is what a normal distribution cut there leaves
// of it.
Eigen::MatrixXd BoundedCovariance(Eigen::MatrixXd covariance,
                                  const Eigen::VectorXd& gradient,
                                  const std::vector<Coordinate>& coordinates,
                                  const Eigen::VectorXd& u);

}  // namespace armcal

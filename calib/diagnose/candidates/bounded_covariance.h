#pragma once

#include <Eigen/Core>
#include <vector>

#include "calib/diagnose/candidates/coordinates.h"

namespace armcal {

using RowMajorMatrix =
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

// The covariance of parameters, in their own units, at the minimum u of half of
// |residual|^2 within the coordinates' bounds: (J' J)^-1 of the coordinates
// times their slopes on both sides (the delta method). J: residual by
// coordinate, as if there were no bounds. Parameters on which nothing depends,
// and those at a bound, have no variance; what the others owe to one at a bound
// is what a normal distribution cut there leaves of it. Zero where a number is
// not finite.
Eigen::MatrixXd BoundedCovariance(const RowMajorMatrix& J,
                                  const Eigen::VectorXd& residual,
                                  const std::vector<Coordinate>& coordinates,
                                  const Eigen::VectorXd& u);

}  // namespace armcal

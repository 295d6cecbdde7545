#pragma once

#include <Eigen/Core>
#include <cmath>

namespace armcal {

inline constexpr double kDegree = M_PI / 180;  // rad

// Turns z onto the axis, of length 1. Of the many such rotations it is the
// smallest for an axis in the upper half space, and the smallest from -z, after
// half a turn about x, for one below; it is exact for axes along x, y and z.
Eigen::Matrix3d RotationOntoAxis(const Eigen::Vector3d& axis);

}  // namespace armcal

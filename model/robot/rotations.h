#pragma once

#include <Eigen/Core>

namespace armcal {

// [v] with [v] w = v x w.
Eigen::Matrix3d CrossProductMatrix(const Eigen::Vector3d& v);
// The rotation R that minimises |R - M|, the polar factor of M, or of -M where
// that is a reflection (Higham 1989).
Eigen::Matrix3d NearestRotation(const Eigen::Matrix3d& M);

}  // namespace armcal

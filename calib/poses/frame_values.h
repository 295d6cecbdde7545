#pragma once

#include <Eigen/Core>

namespace armcal {

// x y z (m) yaw pitch roll (rad) of a frame, as ArmGeometry has base and tool.
Eigen::Matrix<double, 6, 1> FrameValues(const Eigen::Matrix3d& R,
                                        const Eigen::Vector3d& p);

}  // namespace armcal

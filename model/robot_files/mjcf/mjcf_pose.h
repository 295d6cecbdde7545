#pragma once

#include <Eigen/Geometry>

#include "model/robot_files/mjcf/mjcf_defaults.h"
#include "model/robot_files/mjcf/mjcf_settings.h"

namespace armcal {

// An angle as the file's <compiler angle> means it, in rad.
double MjcfAngle(double angle, const MjcfSettings& settings);

// Turns z onto `direction`, by the smallest angle.
Eigen::Matrix3d RotationOfZ(const Eigen::Vector3d& direction);

// The pose that an element gives by pos and one of quat, axisangle, euler,
// xyaxes and zaxis. Throws InputError, also for two of them.
Eigen::Isometry3d ReadMjcfPose(const MjcfElement& element,
                               const MjcfSettings& settings);

}  // namespace armcal

#pragma once

#include <Eigen/Geometry>

#include "model/text/yaml_node.h"

namespace armcal {

// A pose in YAML, all of it optional: xyz in m, and either rpy, fixed-axis
// roll, pitch, yaw in rad, or the nine entries of the rotation, row by row, as
// they are. Throws InputError.
Eigen::Isometry3d ReadYamlPose(const YamlNode& node);

}  // namespace armcal

#pragma once

#include <string>

#include "model/camera/pinhole_camera.h"

namespace armcal {

// Reads a camera's intrinsics as ROS's camera_info has them (what
// camera_calibration and its camera_info_manager write): camera_matrix.data
// (9 numbers, row by row), distortion_coefficients.data (k1 k2 p1 p2 [k3]) and
// distortion_model, which has to be plumb_bob. Throws InputError.
PinholeCamera ReadCamera(const std::string& path);
// The same file's text, of a camera called `name`.
std::string CameraYaml(const PinholeCamera& camera, const std::string& name);

}  // namespace armcal

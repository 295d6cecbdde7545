#pragma once

#include <Eigen/Core>

#include "calib/linear/calibration.h"

namespace armcal {

// Power of each joint's torque error per Hz of bandwidth, (N m)^2 s: the
// variance of a sample times the time it stands for. From the scatter of a
// calibration's equations, which holds what the model lacks as well; NaN where
// they are not of the weak form.
Eigen::VectorXd ErrorDensity(const LinearCalibration& linear);

}  // namespace armcal

#pragma once

#include <Eigen/Core>

#include "model/signals/trajectory.h"
#include "problems/identification_rows.h"

namespace armcal {

// Recorded minus predicted torque at each of t.samples (samples in rows), the
// prediction of parameters x taken between the points of the trajectory's grid.
// Enters the trajectory.
Eigen::MatrixXd SampleResiduals(const Trajectory& t, const Eigen::VectorXd& x,
                                MotionRegressor* regressor);

}  // namespace armcal

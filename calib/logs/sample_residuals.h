#pragma once

#include <Eigen/Core>

#include "model/signals/trajectory.h"
#include "problems/identification_rows.h"

namespace armcal {

struct SampleResiduals {
  Eigen::MatrixXd residual;  // samples x joints, recorded minus predicted
  Eigen::MatrixXd coulomb;   // torque of Coulomb friction, grid x joints
};

// Residuals of torque at each of t.samples, the prediction of parameters x
// taken between the points of the trajectory's grid, N m or N. Enters the
// trajectory.
SampleResiduals EvaluateSamples(const Trajectory& t, const Eigen::VectorXd& x,
                                MotionRegressor* regressor);

}  // namespace armcal

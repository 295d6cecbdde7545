#include "calib/logs/sample_residuals.h"

#include <algorithm>

#include "calib/logs/torque_residual.h"

namespace armcal {

using Eigen::MatrixXd;
using Eigen::VectorXd;

SampleResiduals EvaluateSamples(const Trajectory& t, const VectorXd& x,
                                MotionRegressor* regressor) {
  regressor->Enter(t);
  const MatrixXd grid = PredictTorques(t, x, *regressor);
  MatrixXd residuals = t.samples.tau;
  for (int k = 0; k < t.samples.size(); ++k) {
    const double place = std::clamp(t.samples.place[k], 0.0, t.size() - 1.0);
    const int left = std::min(static_cast<int>(place), t.size() - 2);
    const double share = place - left;
    residuals.row(k) -=
        (1 - share) * grid.row(left) + share * grid.row(left + 1);
  }
  return {residuals, regressor->CoulombTorque(x)};
}

}  // namespace armcal

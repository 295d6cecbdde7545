#include "calib/sample_residuals.h"

#include <algorithm>

namespace armcal {

using Eigen::MatrixXd;
using Eigen::VectorXd;

MatrixXd SampleResiduals(const Trajectory& t, const VectorXd& x,
                         MotionRegressor* regressor) {
  MatrixXd grid(t.size(), t.num_joints()), U;
  regressor->Enter(t);
  for (int k = 0; k < t.size(); ++k) {
    regressor->Differential(k, &U);
    grid.row(k) = (U * x).transpose();
  }
  MatrixXd residuals = t.samples.tau;
  for (int k = 0; k < t.samples.size(); ++k) {
    const double place = std::clamp(t.samples.place[k], 0.0, t.size() - 1.0);
    const int left = std::min(static_cast<int>(place), t.size() - 2);
    const double share = place - left;
    residuals.row(k) -=
        (1 - share) * grid.row(left) + share * grid.row(left + 1);
  }
  return residuals;
}

}  // namespace armcal

#include "calib/poses/outliers.h"

namespace armcal {

std::vector<int> FindOutliers(const PoseFit& fit, const PoseUnknowns& at,
                              const std::vector<int>& rows) {
  Eigen::VectorXd residuals;
  fit.Jacobian(rows, at, &residuals);
  const double limit = LossScale(RobustLoss::kTukey, fit.Coordinates());
  const Eigen::Index per_pose = residuals.size() / rows.size();
  std::vector<int> outliers;
  for (size_t k = 0; k < rows.size(); ++k) {
    const auto r = residuals.segment(k * per_pose, per_pose)
                       .reshaped(fit.Coordinates(), Eigen::AutoSize);
    if (r.colwise().norm().maxCoeff() > limit) outliers.push_back(rows[k]);
  }
  return outliers;
}

}  // namespace armcal

#include "problems/poses/touch_residual.h"

namespace armcal {

using RowMajor =
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

TouchResidual::TouchResidual(std::shared_ptr<const ArmGeometry> geometry,
                             const Eigen::VectorXd& q, double sigma)
    : geometry_(std::move(geometry)), q_(q), sigma_(sigma) {
  set_num_residuals(3);
  *mutable_parameter_block_sizes() = {geometry_->size(), 3};
}

// The tip is TargetResidual's target at the tool's origin: dr/dg =
// twist.At(tip) / sigma. The point is unknown instead, dr/dp = -1 / sigma.
bool TouchResidual::Evaluate(double const* const* parameters, double* residuals,
                             double** jacobians) const {
  const Eigen::Map<const Eigen::Vector3d> p_WQ(parameters[1]);
  std::vector<ParameterTwist> twists;
  const Eigen::Vector3d tip =
      geometry_->ToolPose(q_, parameters[0], &twists).translation();
  Eigen::Map<Eigen::Vector3d> r(residuals);
  r = (tip - p_WQ) / sigma_;
  if (jacobians == nullptr) return true;
  if (jacobians[0] != nullptr) {
    Eigen::Map<RowMajor> J(jacobians[0], 3, geometry_->size());
    for (int k = 0; k < geometry_->size(); ++k) {
      J.col(k) = twists[k].At(tip) / sigma_;
    }
  }
  if (jacobians[1] != nullptr) {
    Eigen::Map<RowMajor>(jacobians[1], 3, 3) =
        -Eigen::Matrix3d::Identity() / sigma_;
  }
  return true;
}

}  // namespace armcal

#include "problems/poses/target_residual.h"

namespace armcal {

using RowMajor =
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

TargetResidual::TargetResidual(std::shared_ptr<const ArmGeometry> geometry,
                               const Eigen::VectorXd& q,
                               const Eigen::Vector3d& p_WQ, double sigma)
    : geometry_(std::move(geometry)), q_(q), p_WQ_(p_WQ), sigma_(sigma) {
  set_num_residuals(3);
  *mutable_parameter_block_sizes() = {geometry_->size(), 3};
}

// p = X_WT p_TQ: a geometric parameter moves it by its twist's velocity there,
// dp/dg = twist.At(p), and p_TQ by the tool's rotation.
bool TargetResidual::Evaluate(double const* const* parameters,
                              double* residuals, double** jacobians) const {
  const Eigen::Map<const Eigen::Vector3d> p_TQ(parameters[1]);
  std::vector<ParameterTwist> twists;
  const Eigen::Isometry3d X_WT =
      geometry_->ToolPose(q_, parameters[0], &twists);
  const Eigen::Vector3d p = X_WT * p_TQ;
  Eigen::Map<Eigen::Vector3d> r(residuals);
  r = (p - p_WQ_) / sigma_;
  if (jacobians == nullptr) return true;
  if (jacobians[0] != nullptr) {
    Eigen::Map<RowMajor> J(jacobians[0], 3, geometry_->size());
    for (int k = 0; k < geometry_->size(); ++k) {
      J.col(k) = twists[k].At(p) / sigma_;
    }
  }
  if (jacobians[1] != nullptr) {
    Eigen::Map<RowMajor>(jacobians[1], 3, 3) = X_WT.linear() / sigma_;
  }
  return true;
}

}  // namespace armcal

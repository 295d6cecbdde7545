#include "problems/poses/tilt_residual.h"

namespace armcal {

using Eigen::Vector2d;
using Eigen::Vector3d;

TiltResidual::TiltResidual(std::shared_ptr<const ArmGeometry> geometry,
                           const Eigen::VectorXd& q, const Vector2d& tilt,
                           double sigma)
    : geometry_(std::move(geometry)), q_(q), tilt_(tilt), sigma_(sigma) {
  set_num_residuals(2);
  *mutable_parameter_block_sizes() = {geometry_->size()};
}

Vector2d TiltErrors(const Eigen::Matrix3d& R_WT, const Vector2d& tilt) {
  const Vector2d up = R_WT.row(2).head<2>();
  return (up.array() - tilt.array().sin()) / tilt.array().cos();
}

// Lengths have derivative 0 here, since a direction does not depend on them.
bool TiltResidual::Evaluate(double const* const* parameters, double* residuals,
                            double** jacobians) const {
  std::vector<ParameterTwist> twists;
  const Eigen::Matrix3d R_WT =
      geometry_->ToolPose(q_, parameters[0], &twists).linear();
  Eigen::Map<Vector2d> r(residuals);
  r = TiltErrors(R_WT, tilt_) / sigma_;
  if (jacobians == nullptr || jacobians[0] == nullptr) return true;
  Eigen::Map<Eigen::Matrix<double, 2, Eigen::Dynamic, Eigen::RowMajor>> J(
      jacobians[0], 2, geometry_->size());
  for (int k = 0; k < geometry_->size(); ++k) {
    // The tool turns by the axis a: e_z' (a x R) = (e_z x a)' R.
    const Vector3d turn = twists[k].rotation
                              ? Vector3d::UnitZ().cross(twists[k].axis)
                              : Vector3d::Zero();
    const Vector2d slope = (R_WT.transpose() * turn).head<2>();
    J.col(k) = slope.array() / tilt_.array().cos() / sigma_;
  }
  return true;
}

}  // namespace armcal

#include "problems/pose_residual.h"

#include <cmath>

namespace armcal {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

Matrix3d Skew(const Vector3d& v) {
  Matrix3d m;
  m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return m;
}

// d(rotation vector) / d(small rotation w applied from the left): the inverse
// of the left Jacobian of SO(3).
Matrix3d LeftJacobianInverse(const Vector3d& v) {
  const double angle = v.norm();
  const Matrix3d S = Skew(v);
  const double c =
      angle < 1e-4 ? 1.0 / 12 + angle * angle / 720
                   : 1 / (angle * angle) -
                         (1 + std::cos(angle)) / (2 * angle * std::sin(angle));
  return Matrix3d::Identity() - 0.5 * S + c * S * S;
}

}  // namespace

PoseResidual::PoseResidual(std::shared_ptr<const ArmGeometry> geometry,
                           const Eigen::VectorXd& q,
                           const Eigen::Isometry3d& X_WM, double sigma_m,
                           double sigma_rad)
    : geometry_(std::move(geometry)),
      q_(q),
      X_WM_(X_WM),
      sigma_m_(sigma_m),
      sigma_rad_(sigma_rad) {
  set_num_residuals(6);
  *mutable_parameter_block_sizes() = {geometry_->size()};
}

bool PoseResidual::Evaluate(double const* const* parameters, double* residuals,
                            double** jacobians) const {
  std::vector<ParameterTwist> twists;
  const Eigen::Isometry3d X_WT =
      geometry_->ToolPose(q_, parameters[0], &twists);
  const Eigen::AngleAxisd turn(
      Matrix3d(X_WT.linear() * X_WM_.linear().transpose()));
  const Vector3d rotation = turn.angle() * turn.axis();
  Eigen::Map<Eigen::Matrix<double, 6, 1>> r(residuals);
  r.head<3>() = (X_WT.translation() - X_WM_.translation()) / sigma_m_;
  r.tail<3>() = rotation / sigma_rad_;
  if (jacobians == nullptr || jacobians[0] == nullptr) return true;
  Eigen::Map<Eigen::Matrix<double, 6, Eigen::Dynamic, Eigen::RowMajor>> J(
      jacobians[0], 6, geometry_->size());
  const Matrix3d from_turn = LeftJacobianInverse(rotation);
  for (int k = 0; k < geometry_->size(); ++k) {
    J.col(k).head<3>() = twists[k].At(X_WT.translation()) / sigma_m_;
    J.col(k).tail<3>() = twists[k].rotation
                             ? Vector3d(from_turn * twists[k].axis / sigma_rad_)
                             : Vector3d::Zero();
  }
  return true;
}

}  // namespace armcal

#include "problems/poses/pose_residual.h"

#include <cmath>

#include "model/robot/rotations.h"

namespace armcal {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

// How the rotation vector v of R = exp([v]x) changes with a small rotation w
// that is applied from the left, dv = J^-1 w, the inverse of the left Jacobian
// of SO(3) (Barfoot 2017, State Estimation for Robotics, 7.1):
//   J^-1 = 1 - [v]x / 2 + c [v]x^2,
//   c = 1 / a^2 - (1 + cos a) / (2 a sin a),  a = |v|.
// Its two terms cancel for small a, where the series 1/12 + a^2 / 720 stands
// in.
Matrix3d LeftJacobianInverse(const Vector3d& v) {
  const double angle = v.norm();
  const Matrix3d S = CrossProductMatrix(v);
  const double c =
      angle < 1e-4 ? 1.0 / 12 + angle * angle / 720
                   : 1 / (angle * angle) -
                         (1 + std::cos(angle)) / (2 * angle * std::sin(angle));
  return Matrix3d::Identity() - 0.5 * S + c * S * S;
}

}  // namespace

PoseResidual::PoseResidual(std::shared_ptr<const ArmGeometry> geometry,
                           const Eigen::VectorXd& q,
                           const Eigen::Isometry3d& X_WM,
                           const Matrix6d& whitening,
                           Eigen::MatrixXd by_instrument)
    : geometry_(std::move(geometry)),
      q_(q),
      X_WM_(X_WM),
      whitening_(whitening),
      by_instrument_(std::move(by_instrument)) {
  set_num_residuals(6);
  *mutable_parameter_block_sizes() = {geometry_->size()};
  if (by_instrument_.cols() > 0) {
    mutable_parameter_block_sizes()->push_back(
        static_cast<int>(by_instrument_.cols()));
  }
}

// The derivative in the geometry: each parameter moves the tool by a twist,
// whose velocity at the tool's origin changes the position and whose rotation
// changes the rotation vector by J^-1 axis.
bool PoseResidual::Evaluate(double const* const* parameters, double* residuals,
                            double** jacobians) const {
  std::vector<ParameterTwist> twists;
  const Eigen::Isometry3d X_WT =
      geometry_->ToolPose(q_, parameters[0], &twists);
  const Eigen::AngleAxisd turn(
      Matrix3d(X_WT.linear() * X_WM_.linear().transpose()));
  const Vector3d rotation = turn.angle() * turn.axis();
  Eigen::Matrix<double, 6, 1> error;
  error << X_WT.translation() - X_WM_.translation(), rotation;
  Eigen::Map<Eigen::Matrix<double, 6, 1>> r(residuals);
  const bool has_unknowns = by_instrument_.cols() > 0;
  if (has_unknowns) {
    error -= by_instrument_ * Eigen::Map<const Eigen::VectorXd>(
                                  parameters[1], by_instrument_.cols());
  }
  r = whitening_ * error;
  if (jacobians == nullptr) return true;
  if (has_unknowns && jacobians[1] != nullptr) {
    Eigen::Map<Eigen::Matrix<double, 6, Eigen::Dynamic, Eigen::RowMajor>> by(
        jacobians[1], 6, by_instrument_.cols());
    by = -whitening_ * by_instrument_;
  }
  if (jacobians[0] == nullptr) return true;
  Eigen::Map<Eigen::Matrix<double, 6, Eigen::Dynamic, Eigen::RowMajor>> J(
      jacobians[0], 6, geometry_->size());
  const Matrix3d from_turn = LeftJacobianInverse(rotation);
  for (int k = 0; k < geometry_->size(); ++k) {
    error.head<3>() = twists[k].At(X_WT.translation());
    error.tail<3>() = twists[k].rotation ? Vector3d(from_turn * twists[k].axis)
                                         : Vector3d::Zero();
    J.col(k) = whitening_ * error;
  }
  return true;
}

}  // namespace armcal

#include "calib/poses/cameras/camera_rig.h"

#include "calib/poses/frame_values.h"
#include "model/robot/rotations.h"

namespace armcal {

using Eigen::Isometry3d;
using Eigen::Matrix3d;
using Eigen::Vector3d;
using Vector6d = Eigen::Matrix<double, 6, 1>;

CameraRig::CameraRig(CameraPlace place, const HandEye& first,
                     const HandEye& further,
                     const std::vector<Isometry3d>& seen)
    : place_(place) {
  if (place == CameraPlace::kOnTool) {
    X_ = further.X_ET.inverse() * first.X_ET;
    return;
  }
  X_ = first.X_WB * further.X_WB.inverse();
  for (const Isometry3d& X : seen) {
    middle_ += InFirst(X).translation() / static_cast<double>(seen.size());
  }
}

Isometry3d CameraRig::InFirst(const Isometry3d& seen) const {
  return place_ == CameraPlace::kOnTool ? seen * X_ : X_ * seen;
}

Matrix6d CameraRig::Carry(const Isometry3d& seen) const {
  Matrix6d carry = Matrix6d::Zero();
  if (place_ == CameraPlace::kStanding) {
    carry.topLeftCorner<3, 3>() = carry.bottomRightCorner<3, 3>() = X_.linear();
    return carry;
  }
  const Vector3d lever = InFirst(seen).translation() - seen.translation();
  carry.setIdentity();
  carry.topRightCorner<3, 3>() = -CrossProductMatrix(lever);
  return carry;
}

Matrix6d CameraRig::Moves(const Isometry3d& seen) const {
  const Isometry3d X_WT = InFirst(seen);
  Matrix6d moves = Matrix6d::Identity();
  if (place_ == CameraPlace::kOnTool) {
    moves.topLeftCorner<3, 3>() = moves.bottomRightCorner<3, 3>() =
        X_WT.linear();
  } else {
    moves.topRightCorner<3, 3>() =
        -CrossProductMatrix(X_WT.translation() - middle_);
  }
  return moves;
}

Isometry3d CameraRig::Moved(const Vector6d& by) const {
  if (place_ == CameraPlace::kOnTool) {
    return X_ * Displaced(Isometry3d::Identity(), by);
  }
  Isometry3d X = X_;
  X.translation() -= middle_;
  const Matrix3d turn = Displaced(Isometry3d::Identity(), by).linear();
  X = Isometry3d(turn) * X;
  X.translation() += middle_ + by.head<3>();
  return X;
}

Vector6d CameraRig::ValuesOf(const Isometry3d& X) {
  return FrameValues(X.linear(), X.translation());
}

Matrix6d CameraRig::ValuesByMoves() const {
  constexpr double kStep = 1e-6;
  Matrix6d J;
  for (int k = 0; k < 6; ++k) {
    const Vector6d step = kStep * Vector6d::Unit(k);
    J.col(k) = (ValuesOf(Moved(step)) - ValuesOf(Moved(-step))) / (2 * kStep);
  }
  return J;
}

}  // namespace armcal

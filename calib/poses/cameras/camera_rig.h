#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "calib/poses/cameras/image_view.h"
#include "calib/poses/hand_eye.h"

namespace armcal {

// Where a further camera is beside the first one: of cameras on the tool X_CT,
// the first camera's frame T in the further one's C; of standing cameras X_WC,
// the further one's in the first one's W.
class CameraRig {
 public:
  // From hand-eye calibrations of both; `seen` are the poses of the tool as the
  // further camera sees it, in its own frames.
  CameraRig(CameraPlace place, const HandEye& first, const HandEye& further,
            const std::vector<Eigen::Isometry3d>& seen);

  const Eigen::Isometry3d& X() const { return X_; }
  // X_WT in the first camera's frames of a pose in the further one's.
  Eigen::Isometry3d InFirst(const Eigen::Isometry3d& seen) const;
  // How displacements and rotations of the pose `seen` move InFirst's (6 x 6).
  Matrix6d Carry(const Eigen::Isometry3d& seen) const;
  // How InFirst's pose moves with where the further camera is: a displacement
  // (m) and a rotation (rad), of T in T's axes, of C in W's about the middle of
  // what it saw.
  Matrix6d Moves(const Eigen::Isometry3d& seen) const;
  // x y z (m) yaw pitch roll (rad) of X, and their derivatives by the same.
  Eigen::Matrix<double, 6, 1> Values() const { return ValuesOf(X_); }
  Matrix6d ValuesByMoves() const;

 private:
  static Eigen::Matrix<double, 6, 1> ValuesOf(const Eigen::Isometry3d& X);
  Eigen::Isometry3d Moved(const Eigen::Matrix<double, 6, 1>& by) const;

  CameraPlace place_;
  Eigen::Isometry3d X_;
  Eigen::Vector3d middle_ = Eigen::Vector3d::Zero();  // in W, standing cameras
};

}  // namespace armcal

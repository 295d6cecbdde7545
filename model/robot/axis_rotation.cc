#include "model/robot/axis_rotation.h"

namespace armcal {

using Eigen::Matrix3d;
using Eigen::Vector3d;

Matrix3d RotationOntoAxis(const Vector3d& axis) {
  const Matrix3d half_turn = Vector3d(1, -1, -1).asDiagonal();
  const bool is_below = axis.z() < 0;
  const Vector3d a = is_below ? half_turn * axis : axis;
  // Rodrigues' formula with v = z x a and cosine a.z.
  const Vector3d v(-a.y(), a.x(), 0);
  Matrix3d V;
  V << 0, 0, v.y(), 0, 0, -v.x(), -v.y(), v.x(), 0;
  const Matrix3d R = Matrix3d::Identity() + V + V * V / (1 + a.z());
  return is_below ? Matrix3d(half_turn * R) : R;
}

}  // namespace armcal

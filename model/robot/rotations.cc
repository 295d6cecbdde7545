#include "model/robot/rotations.h"

#include <Eigen/LU>
#include <Eigen/SVD>

namespace armcal {

using Eigen::Matrix3d;

Matrix3d CrossProductMatrix(const Eigen::Vector3d& v) {
  Matrix3d m;
  m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return m;
}

Matrix3d NearestRotation(const Matrix3d& M) {
  const Eigen::JacobiSVD<Matrix3d> svd(
      M, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const Matrix3d R = svd.matrixU() * svd.matrixV().transpose();
  return R.determinant() < 0 ? Matrix3d(-R) : R;
}

}  // namespace armcal

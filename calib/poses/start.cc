#include "calib/poses/start.h"

#include <Eigen/Geometry>
#include <Eigen/QR>
#include <cmath>

namespace armcal {
namespace {

using Eigen::Matrix3Xd;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// Tool positions at nominal geometry with the base at the world's origin.
Matrix3Xd ToolPositions(const ArmGeometry& geometry,
                        const PoseMeasurements& measured) {
  const VectorXd values = geometry.Values();
  Matrix3Xd p(3, measured.size());
  for (int k = 0; k < measured.size(); ++k) {
    p.col(k) = geometry.ToolPose(measured.q.row(k), values.data(), nullptr)
                   .translation();
  }
  return p;
}

// |p - a|^2 = (L - c)^2 is linear in a, c and |a|^2 - c^2.
VectorXd Trilaterate(const Matrix3Xd& p, const VectorXd& lengths) {
  MatrixXd A(p.cols(), 5);
  A.leftCols(3) = 2 * p.transpose();
  A.col(3) = -2 * lengths;
  A.col(4).setOnes();
  const VectorXd b =
      p.colwise().squaredNorm().transpose() - lengths.cwiseAbs2();
  const VectorXd x = A.colPivHouseholderQr().solve(b);
  VectorXd anchor(4);
  anchor << x.head<3>(), x[3];
  return anchor;
}

void SetBase(const Eigen::Matrix4d& X, VectorXd* geometry) {
  const Eigen::Matrix3d R = X.topLeftCorner<3, 3>();
  (*geometry)[0] = X(0, 3);
  (*geometry)[1] = X(1, 3);
  (*geometry)[2] = X(2, 3);
  (*geometry)[3] = std::atan2(R(1, 0), R(0, 0));
  (*geometry)[4] = std::atan2(-R(2, 0), std::hypot(R(2, 1), R(2, 2)));
  (*geometry)[5] = std::atan2(R(2, 1), R(2, 2));
}

}  // namespace

PoseUnknowns StartPoses(const ArmGeometry& geometry,
                        const PoseMeasurements& measured) {
  PoseUnknowns start;
  start.geometry = geometry.Values();
  start.other = VectorXd::Zero(PoseUnknowns::NumOther(measured));
  const Matrix3Xd p = ToolPositions(geometry, measured);
  if (measured.lengths.size() > 0) {
    start.other = Trilaterate(p, measured.lengths);
    return start;
  }
  Matrix3Xd seen = Matrix3Xd::Zero(3, measured.size());
  for (const MatrixXd& target : measured.targets) {
    seen += target.transpose() / static_cast<double>(measured.targets.size());
  }
  if (measured.poses.size() > 0) {
    seen = measured.poses.leftCols(3).transpose();
  }
  SetBase(Eigen::umeyama(p, seen, false), &start.geometry);
  return start;
}

}  // namespace armcal

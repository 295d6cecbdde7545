#include "calib/poses/start.h"

#include <Eigen/Geometry>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "calib/poses/frame_values.h"
#include "calib/poses/hand_eye.h"
#include "model/robot/rotations.h"
#include "problems/poses/plane_residual.h"
#include "problems/poses/pose_problem.h"

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

// Where the points are that the tool touches: means of its nominal tips.
VectorXd PointsOf(const Matrix3Xd& p, const PoseMeasurements& measured) {
  VectorXd points = VectorXd::Zero(3 * measured.num_points());
  for (int k = 0; k < measured.size(); ++k) {
    const int point = measured.touched[k];
    const auto times =
        std::count(measured.touched.begin(), measured.touched.end(), point);
    points.segment<3>(3 * point) += p.col(k) / static_cast<double>(times);
  }
  return points;
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

// The base and the tool of whole poses, neither of which need be near the
// file's: a camera may look anywhere.
void SetBaseAndTool(const ArmGeometry& geometry,
                    const PoseMeasurements& measured, VectorXd* values) {
  std::vector<Eigen::Isometry3d> seen;
  for (int k = 0; k < measured.size(); ++k) {
    seen.push_back(MeasuredPose(measured, k));
  }
  const std::optional<HandEye> frames =
      SolveHandEye(geometry, *values, measured.q, seen);
  if (!frames) return;
  values->head<6>() =
      FrameValues(frames->X_WB.linear(), frames->X_WB.translation());
  values->tail<6>() =
      FrameValues(frames->X_ET.linear(), frames->X_ET.translation());
}

// The base as the file has it against gravity; the inclinometer on the last
// link turned as its readings are best told: the rotation R_FT with R_FT' u = s
// of the upward directions u in the last link's frame and s in the
// inclinometer's (Wahba 1965, by a singular value decomposition as Kabsch's).
// An inclinometer that measures small angles does not hang upside down.
void SetLevelAndTool(const ArmGeometry& geometry,
                     const PoseMeasurements& measured, VectorXd* values) {
  VectorXd bare = *values;
  bare.tail<6>().setZero();
  Eigen::Matrix3d products = Eigen::Matrix3d::Zero();
  for (int k = 0; k < measured.size(); ++k) {
    const Eigen::Matrix3d R_WF =
        geometry.ToolPose(measured.q.row(k), bare.data(), nullptr).linear();
    const Eigen::Vector2d s = measured.tilts.row(k).array().sin();
    const double z = std::sqrt(std::max(0., 1 - s.squaredNorm()));
    products += R_WF.row(2).transpose() * Eigen::RowVector3d(s.x(), s.y(), z);
  }
  values->tail<6>() =
      FrameValues(NearestRotation(products), Eigen::Vector3d::Zero());
}

}  // namespace

// Each kind of measurement has its closed form: trilateration of a wire,
// directions of an inclinometer, means of touches, and of positions the
// rotation and shift that align them (Umeyama 1991, IEEE T-PAMI 13).
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
  if (measured.tilts.size() > 0) {
    SetLevelAndTool(geometry, measured, &start.geometry);
    return start;
  }
  if (measured.planes) {
    TouchedPlanes(geometry, measured, &start.other);
    return start;
  }
  if (!measured.touched.empty()) {
    start.other = PointsOf(p, measured);
    return start;
  }
  Matrix3Xd seen = Matrix3Xd::Zero(3, measured.size());
  for (const MatrixXd& target : measured.targets) {
    seen += target.transpose() / static_cast<double>(measured.targets.size());
  }
  if (measured.poses.size() > 0) {
    seen = measured.poses.leftCols(3).transpose();
  }
  const Eigen::Matrix4d X_WB = Eigen::umeyama(p, seen, false);
  start.geometry.head<6>() =
      FrameValues(X_WB.topLeftCorner<3, 3>(), X_WB.topRightCorner<3, 1>());
  if (measured.poses.size() > 0) {
    SetBaseAndTool(geometry, measured, &start.geometry);
  }
  return start;
}

}  // namespace armcal

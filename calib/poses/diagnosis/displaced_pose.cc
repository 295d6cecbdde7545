#include "calib/poses/diagnosis/displaced_pose.h"

#include <algorithm>

namespace armcal {

using Eigen::Isometry3d;
using Eigen::Matrix3d;
using Eigen::Matrix3Xd;
using Eigen::Vector3d;
using Eigen::VectorXd;

namespace {

// A rotation about a point, and a shift.
Isometry3d About(const Vector3d& point, const Vector3d& turn,
                 const Vector3d& shift) {
  Isometry3d X = Isometry3d::Identity();
  X.linear() = Eigen::AngleAxisd(turn.norm(), turn.stableNormalized()).matrix();
  X.translation() = point + shift - X.linear() * point;
  return X;
}

Vector3d Turned(const Matrix3Xd& points, const Vector3d& axis,
                const Vector3d& about, Matrix3Xd* velocity) {
  for (Eigen::Index t = 0; t < points.cols(); ++t) {
    velocity->col(t) = axis.cross(points.col(t) - about);
  }
  return axis;
}

Vector3d Shifted(const Vector3d& along, Matrix3Xd* velocity) {
  velocity->colwise() = along;
  return Vector3d::Zero();
}

}  // namespace

Isometry3d BasePose(const VectorXd& geometry) {
  Isometry3d X = Isometry3d::Identity();
  X.translation() = geometry.head<3>();
  X.linear() = RotationFromRpy({geometry[5], geometry[4], geometry[3]});
  return X;
}

Vector3d RotationVector(const Matrix3d& R) {
  const Eigen::AngleAxisd turn(R);
  return turn.angle() * turn.axis();
}

int PoseMovers::Index(PoseTerm::Acts acts, int index) const {
  switch (acts) {
    case PoseTerm::Acts::kJoint:
      return index;
    case PoseTerm::Acts::kBase:
      return joints_ + index;
    case PoseTerm::Acts::kTool:
      return joints_ + 3 + index;
    case PoseTerm::Acts::kFrame:
      return joints_ + 9 + index;
    case PoseTerm::Acts::kScale:
      return joints_ + 15;
    case PoseTerm::Acts::kLength:
      return joints_ + 16;
    case PoseTerm::Acts::kTarget:
      break;
  }
  return joints_ + 17 + index;
}

// From the inside out: joints, the arm, the tool's body and its targets, then
// the scale about the base, the base's rotation and the instrument's frame.
DisplacedPose::DisplacedPose(const ArmGeometry& geometry,
                             const PoseMovers& movers,
                             const PoseUnknowns& unknowns, const VectorXd& q0,
                             const VectorXd& by, const Vector3d& middle,
                             bool with_twists)
    : q(q0 + by.head(movers.joints())) {
  const int n = movers.joints();
  const Isometry3d X_WB = BasePose(unknowns.geometry);
  base = X_WB.translation();
  moved = About(middle, by.segment<3>(n + 12), by.segment<3>(n + 9)) *
          About(base, X_WB.linear() * by.segment<3>(n), Vector3d::Zero());
  scale = 1 + by[n + 15];
  length = by[n + 16];
  X_WT = geometry.ToolPose(q, unknowns.geometry.data(),
                           with_twists ? &parameters : nullptr,
                           with_twists ? &joints : nullptr);
  X_TB = About(Vector3d::Zero(), by.segment<3>(n + 6), by.segment<3>(n + 3));
  on_tool = Matrix3Xd::Zero(3, std::max(1, movers.targets()));
  for (int t = 0; t < movers.targets(); ++t) {
    on_tool.col(t) =
        unknowns.other.segment<3>(3 * t) + by.segment<3>(n + 17 + 3 * t);
  }
  const Isometry3d X_WBody = X_WT * X_TB;
  points = on_tool;
  for (Eigen::Index t = 0; t < points.cols(); ++t) {
    const Vector3d p = X_WBody * Vector3d(on_tool.col(t));
    points.col(t) = moved * Vector3d(base + scale * (p - base));
  }
  R = moved.linear() * X_WBody.linear();
}

Vector3d DisplacedPose::ByTwist(const ParameterTwist& twist,
                                Matrix3Xd* velocity) const {
  const Isometry3d X_WBody = X_WT * X_TB;
  for (Eigen::Index t = 0; t < on_tool.cols(); ++t) {
    const Vector3d p = X_WBody * Vector3d(on_tool.col(t));
    velocity->col(t) = moved.linear() * (scale * twist.At(p));
  }
  if (!twist.rotation) return Vector3d::Zero();
  return moved.linear() * twist.axis;
}

// Velocities of the points by each mover, in the order of PoseMovers::Index: a
// turn about a point moves them by axis x (p - point), a shift by itself, the
// scale by p - base.
Vector3d DisplacedPose::ByMover(const PoseMovers& movers,
                                const PoseUnknowns& unknowns, int k,
                                const Vector3d& middle,
                                Matrix3Xd* velocity) const {
  const int n = movers.joints();
  if (k < n) return ByTwist(joints[k], velocity);
  const Isometry3d tool = moved * X_WT;
  const int kind = (k - n) / 3, axis = (k - n) % 3;
  const Vector3d e = Vector3d::Unit(axis);
  switch (kind) {
    case 0:
      return Turned(points, BasePose(unknowns.geometry).linear() * e, base,
                    velocity);
    case 1:
      return Shifted(tool.linear() * e, velocity);
    case 2:
      return Turned(points, tool.linear() * e, tool.translation(), velocity);
    case 3:
      return Shifted(e, velocity);
    case 4:
      return Turned(points, e, middle, velocity);
    default:
      break;
  }
  velocity->setZero();
  if (k == n + 15) *velocity = points.colwise() - base;
  if (k >= n + 17) velocity->col((k - n - 17) / 3) = R.col((k - n - 17) % 3);
  return Vector3d::Zero();
}

}  // namespace armcal

#include "calib/poses/cameras/board_start.h"

#include <Eigen/LU>
#include <Eigen/SVD>
#include <cmath>

#include "model/robot/rotations.h"

namespace armcal {
namespace {

using Eigen::Isometry3d;
using Eigen::Matrix2Xd;
using Eigen::Matrix3d;
using Eigen::Matrix3Xd;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

// Of the spread of a board's points: how far from a plane they may be in one.
constexpr double kFlat = 1e-3;
// Of the smallest but one singular value of the start's equations over the
// largest: with less the points are on a line.
constexpr double kSecondProjection = 1e-6;

}  // namespace

BoardAxes::BoardAxes(const Matrix3Xd& points) : mean(points.rowwise().mean()) {
  const Matrix3Xd about = points.colwise() - mean;
  const Eigen::JacobiSVD<MatrixXd> svd(about, Eigen::ComputeFullU);
  axes = svd.matrixU();
  if (axes.determinant() < 0) axes.col(2) *= -1;
  own = axes.transpose() * about;
  size = svd.singularValues()[0] / std::sqrt(points.cols());
  is_flat = svd.singularValues()[2] < kFlat * svd.singularValues()[0];
}

// x3 of (x1, x2, x3) = P (s, 1) is not known, but x1 - u x3 = 0 and x2 - v x3 =
// 0 are linear in P. The solution of length 1 is the singular vector of the
// least singular value; two small ones mean that another projection fits as
// well.
std::optional<MatrixXd> Projection(const MatrixXd& points,
                                   const Matrix2Xd& seen) {
  const Eigen::Index d = points.rows() + 1, count = points.cols();
  MatrixXd A = MatrixXd::Zero(2 * count, 3 * d);
  for (Eigen::Index k = 0; k < count; ++k) {
    const Eigen::RowVectorXd s = points.col(k).homogeneous().transpose();
    A.row(2 * k).head(d) = s;
    A.row(2 * k).tail(d) = -seen(0, k) * s;
    A.row(2 * k + 1).segment(d, d) = s;
    A.row(2 * k + 1).tail(d) = -seen(1, k) * s;
  }
  const Eigen::JacobiSVD<MatrixXd> svd(A, Eigen::ComputeFullV);
  const VectorXd& values = svd.singularValues();
  const Eigen::Index second = 3 * d - 2;
  if (values.size() <= second ||
      !(values[second] > kSecondProjection * values[0]))
    return std::nullopt;
  const VectorXd p = svd.matrixV().col(3 * d - 1);
  MatrixXd P(3, d);
  for (int i = 0; i < 3; ++i) P.row(i) = p.segment(i * d, d).transpose();
  return P;
}

// P is a multiple of (R, p), whose factor follows from det R = 1 and whose sign
// from the board being before the camera. A flat board has no third column of
// R: it is the cross product of the others. The nearest rotation is taken of
// what noise leaves.
std::optional<Isometry3d> StartOfBoard(const Matrix3Xd& points,
                                       const Matrix2Xd& directions) {
  const BoardAxes board(points);
  if (!(board.size > 0)) return std::nullopt;
  const int d = board.is_flat ? 2 : 3;
  const auto P = Projection(board.own.topRows(d) / board.size, directions);
  if (!P) return std::nullopt;
  Matrix3d M;
  if (board.is_flat) {
    const Vector3d a = P->col(0), b = P->col(1);
    M << a, b, a.cross(b) / std::sqrt(a.norm() * b.norm());
  } else {
    M = P->leftCols(3);
  }
  const double scale = std::cbrt(std::abs(M.determinant()));
  Vector3d p = P->rightCols(1) / scale * board.size;
  if (p.z() < 0) {
    p = -p;
    M.leftCols(d) *= -1;
  }
  Isometry3d X = Isometry3d::Identity();
  X.linear() = NearestRotation(M) * board.axes.transpose();
  X.translation() = p - X.linear() * board.mean;
  return X;
}

}  // namespace armcal

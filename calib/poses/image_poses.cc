#include "calib/poses/image_poses.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "calib/numerics/median.h"
#include "model/robot/rotations.h"
#include "model/text/input_error.h"

namespace armcal {
namespace {

using Eigen::Isometry3d;
using Eigen::Matrix2Xd;
using Eigen::Matrix3d;
using Eigen::Matrix3Xd;
using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::VectorXd;
using Vector6d = Eigen::Matrix<double, 6, 1>;

// Of the spread of a board's points: how far from a plane they may be in one.
constexpr double kFlat = 1e-3;
// Of the smallest but one singular value of the start's equations over the
// largest: with less the points are on a line.
constexpr double kSecondProjection = 1e-6;
constexpr double kHuber = 1.345;  // standard deviations (Huber 1981)
constexpr int kMostPoseSteps = 50;

// The entries, row by row, of the 3 x (d + 1) matrix P with x ~ P (s, 1) for
// points s (d) seen in the directions x; nothing where they do not tell it.
std::optional<MatrixXd> Projection(const MatrixXd& points,
                                   const Matrix2Xd& directions) {
  const Eigen::Index d = points.rows() + 1, count = points.cols();
  MatrixXd A = MatrixXd::Zero(2 * count, 3 * d);
  for (Eigen::Index k = 0; k < count; ++k) {
    const Eigen::RowVectorXd s = points.col(k).homogeneous().transpose();
    A.row(2 * k).head(d) = s;
    A.row(2 * k).tail(d) = -directions(0, k) * s;
    A.row(2 * k + 1).segment(d, d) = s;
    A.row(2 * k + 1).tail(d) = -directions(1, k) * s;
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

// The board's points about their mean along the axes of their spread, the
// smallest last.
struct BoardAxes {
  explicit BoardAxes(const Matrix3Xd& points) : mean(points.rowwise().mean()) {
    const Matrix3Xd about = points.colwise() - mean;
    const Eigen::JacobiSVD<MatrixXd> svd(about, Eigen::ComputeFullU);
    axes = svd.matrixU();
    if (axes.determinant() < 0) axes.col(2) *= -1;
    own = axes.transpose() * about;
    size = svd.singularValues()[0] / std::sqrt(points.cols());
    is_flat = svd.singularValues()[2] < kFlat * svd.singularValues()[0];
  }
  Vector3d mean;
  Matrix3d axes;
  Matrix3Xd own;
  double size;
  bool is_flat;
};

// X_CB near where the pixels say; nothing where they do not tell it.
std::optional<Isometry3d> StartOf(const Matrix3Xd& points,
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

// An image at a pose X_WT of the tool.
class ImageAt {
 public:
  ImageAt(const Matrix3Xd& points, const Matrix2Xd& pixels,
          const PinholeCamera& camera, CameraPlace place)
      : points_(points), pixels_(pixels), camera_(camera), place_(place) {}

  // Pixels' errors, predicted less seen, two a point; and their derivatives by
  // a displacement (m) and a rotation (rad) of the tool, both in W.
  bool Errors(const Isometry3d& X_WT, VectorXd* r, MatrixXd* J) const {
    const Isometry3d X_TW = X_WT.inverse();
    r->resize(2 * points_.cols());
    J->resize(2 * points_.cols(), 6);
    for (Eigen::Index k = 0; k < points_.cols(); ++k) {
      Eigen::Matrix<double, 3, 6> motion;
      Vector3d p;
      if (place_ == CameraPlace::kStanding) {
        p = X_WT * points_.col(k);
        motion << Matrix3d::Identity(),
            -CrossProductMatrix(p - X_WT.translation());
      } else {
        p = X_TW * points_.col(k);
        motion << -X_TW.linear(),
            X_TW.linear() *
                CrossProductMatrix(points_.col(k) - X_WT.translation());
      }
      if (!(p.z() > 0)) return false;
      Eigen::Matrix<double, 2, 3> by_point;
      r->segment<2>(2 * k) = camera_.Project(p, &by_point) - pixels_.col(k);
      J->middleRows<2>(2 * k) = by_point * motion;
    }
    return true;
  }

 private:
  const Matrix3Xd& points_;
  const Matrix2Xd& pixels_;
  const PinholeCamera& camera_;
  CameraPlace place_;
};

// Huber's weights of points' errors; `stddev` of a coordinate, px.
VectorXd Weights(const VectorXd& r, double stddev) {
  VectorXd weights(r.size());
  for (Eigen::Index k = 0; k < r.size(); k += 2) {
    const double size = r.segment<2>(k).norm() / std::sqrt(2.);
    const double weight = size > kHuber * stddev ? kHuber * stddev / size : 1;
    weights.segment<2>(k).setConstant(weight);
  }
  return weights;
}

Isometry3d Displaced(const Isometry3d& X, const Vector6d& by) {
  Isometry3d moved = X;
  const Vector3d turn = by.tail<3>();
  if (turn.norm() > 0) {
    moved.linear() =
        Eigen::AngleAxisd(turn.norm(), turn.normalized()) * X.linear();
  }
  moved.translation() += by.head<3>();
  return moved;
}

// Huber's, of points.
double Cost(const VectorXd& r, double stddev) {
  const double knee = kHuber * stddev;
  double cost = 0;
  for (Eigen::Index k = 0; k < r.size(); k += 2) {
    const double size = r.segment<2>(k).norm() / std::sqrt(2.);
    cost += size > knee ? knee * (2 * size - knee) : size * size;
  }
  return cost;
}

// Minimises the errors by Levenberg and Marquardt from *X; whether it ends with
// all points before the camera.
bool FitImage(const ImageAt& image, double stddev, Isometry3d* X) {
  constexpr double kSettled = 1e-12;
  VectorXd r, tried;
  MatrixXd J, by;
  if (!image.Errors(*X, &r, &J)) return false;
  double damping = 1e-6;
  for (int step = 0; step < kMostPoseSteps && damping < 1e6; ++step) {
    const VectorXd weights = Weights(r, stddev);
    Matrix6d A = J.transpose() * weights.asDiagonal() * J;
    A.diagonal() *= 1 + damping;
    const Vector6d move =
        A.ldlt().solve(-J.transpose() * weights.cwiseProduct(r));
    const Isometry3d moved = Displaced(*X, move);
    if (!image.Errors(moved, &tried, &by) ||
        Cost(tried, stddev) > Cost(r, stddev)) {
      damping = std::max(1e-6, 10 * damping);
      continue;
    }
    const bool settled = (J * move).squaredNorm() <= kSettled * r.squaredNorm();
    *X = moved, r = tried, J = by;
    damping /= 10;
    if (settled) break;
  }
  return true;
}

// 1.4826 times the median of all coordinates' absolute errors, corrected for
// the six unknowns of each image.
double PixelDeviation(const std::vector<VectorXd>& errors) {
  std::vector<double> sizes;
  for (const VectorXd& r : errors) {
    for (const double e : r) sizes.push_back(std::abs(e));
  }
  const auto count = static_cast<double>(sizes.size());
  const double left =
      std::max(1., count - 6 * static_cast<double>(errors.size()));
  return std::max(1e-6, 1.4826 * Median(sizes) * std::sqrt(count / left));
}

void SetPose(const Isometry3d& X, int row, PoseMeasurements* measured) {
  const Eigen::Quaterniond turn(X.linear());
  measured->poses.row(row) << X.translation().transpose(), turn.w(), turn.x(),
      turn.y(), turn.z();
}

}  // namespace

PoseMeasurements MeasurePoses(const std::string& file,
                              const BoardImages& images,
                              const PinholeCamera& camera, CameraPlace place) {
  constexpr double kFirstDeviation = 1e9;  // px: all alike
  std::vector<ImageAt> views;
  std::vector<Isometry3d> poses;
  for (int k = 0; k < images.size(); ++k) {
    views.emplace_back(images.points[k], images.pixels[k], camera, place);
    Matrix2Xd directions = images.pixels[k];
    for (Eigen::Index i = 0; i < directions.cols(); ++i) {
      directions.col(i) = camera.Normalised(images.pixels[k].col(i));
    }
    const auto X_CB = StartOf(images.points[k], directions);
    if (X_CB) {
      poses.push_back(place == CameraPlace::kStanding ? *X_CB
                                                      : X_CB->inverse());
    }
    if (!X_CB || !FitImage(views[k], kFirstDeviation, &poses.back())) {
      throw InputError(file, "row " + std::to_string(images.row[k]), "",
                       "the points of this image do not tell where the board "
                       "is: expected four or more that are not on a line");
    }
  }
  PoseMeasurements measured;
  std::vector<VectorXd> errors(views.size());
  MatrixXd J;
  for (const bool robust : {false, true}) {
    for (size_t k = 0; k < views.size(); ++k) {
      if (robust) FitImage(views[k], measured.pixel_stddev, &poses[k]);
      views[k].Errors(poses[k], &errors[k], &J);
    }
    measured.pixel_stddev = PixelDeviation(errors);
  }
  measured.q = images.q;
  measured.row = images.row;
  measured.number = images.number;
  measured.poses.resize(images.size(), 7);
  for (int k = 0; k < images.size(); ++k) {
    SetPose(poses[k], k, &measured);
    views[k].Errors(poses[k], &errors[k], &J);
    const VectorXd weights = Weights(errors[k], measured.pixel_stddev);
    const Matrix6d information = J.transpose() * weights.asDiagonal() * J /
                                 std::pow(measured.pixel_stddev, 2);
    measured.covariance.push_back(
        information.llt().solve(Matrix6d::Identity()));
  }
  return measured;
}

}  // namespace armcal

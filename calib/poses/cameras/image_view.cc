#include "calib/poses/cameras/image_view.h"

#include <algorithm>
#include <cmath>

#include "calib/numerics/median.h"
#include "model/robot/rotations.h"

namespace armcal {
namespace {

using Eigen::Isometry3d;
using Eigen::Matrix3d;
using Eigen::Vector3d;
using Eigen::VectorXd;

// Standard deviations (Holland and Welsch 1977).
constexpr double kHuber = 1.345;

// Of point k: its error over sqrt(2), as large as a coordinate's.
double PointError(const VectorXd& r, Eigen::Index k) {
  return r.segment<2>(k).norm() / std::sqrt(2.);
}

}  // namespace

// Projection minus pixel of every point, and by the chain rule d pixel / d
// point times how the point moves with a shift and a turn of the tool about its
// origin. A standing camera is W and sees the board on T; a carried one is T
// and sees it in W.
bool ImageView::Errors(const PinholeCamera& camera, const Isometry3d& X_WT,
                       ImageErrors* errors) const {
  const Isometry3d X_TW = X_WT.inverse();
  errors->r.resize(2 * points_.cols());
  errors->by_pose.resize(2 * points_.cols(), 6);
  errors->by_lens.resize(2 * points_.cols(), PinholeCamera::kLensSize);
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
    PinholeCamera::ByLens by_lens;
    errors->r.segment<2>(2 * k) =
        camera.Project(p, &by_point, &by_lens) - pixels_.col(k);
    errors->by_pose.middleRows<2>(2 * k) = by_point * motion;
    errors->by_lens.middleRows<2>(2 * k) = by_lens;
  }
  return true;
}

VectorXd HuberWeights(const VectorXd& r, double stddev) {
  VectorXd weights(r.size());
  for (Eigen::Index k = 0; k < r.size(); k += 2) {
    const double size = PointError(r, k);
    const double weight = size > kHuber * stddev ? kHuber * stddev / size : 1;
    weights.segment<2>(k).setConstant(weight);
  }
  return weights;
}

double HuberCost(const VectorXd& r, double stddev) {
  const double knee = kHuber * stddev;
  double cost = 0;
  for (Eigen::Index k = 0; k < r.size(); k += 2) {
    const double size = PointError(r, k);
    cost += size > knee ? knee * (2 * size - knee) : size * size;
  }
  return cost;
}

double PixelDeviation(const std::vector<ImageErrors>& errors, double unknowns) {
  std::vector<double> sizes;
  for (const ImageErrors& image : errors) {
    for (const double e : image.r) sizes.push_back(std::abs(e));
  }
  const auto count = static_cast<double>(sizes.size());
  const double left = std::max(1., count - unknowns);
  return std::max(1e-6, 1.4826 * Median(sizes) * std::sqrt(count / left));
}

Isometry3d Displaced(const Isometry3d& X,
                     const Eigen::Matrix<double, 6, 1>& by) {
  Isometry3d moved = X;
  const Vector3d turn = by.tail<3>();
  if (turn.norm() > 0) {
    moved.linear() =
        Eigen::AngleAxisd(turn.norm(), turn.normalized()) * X.linear();
  }
  moved.translation() += by.head<3>();
  return moved;
}

}  // namespace armcal

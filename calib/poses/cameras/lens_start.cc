#include "calib/poses/cameras/lens_start.h"

#include <Eigen/LU>
#include <Eigen/SVD>
#include <cmath>

#include "calib/poses/cameras/board_start.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::VectorXd;

// Of the equations' singular values: with less another lens fits as well.
constexpr double kSecondLens = 1e-6;

// Pixels about their mean and over their spread, so that the entries of B are
// of one size.
struct PixelScale {
  explicit PixelScale(const std::vector<ImageView>& views) {
    double count = 0, squares = 0;
    for (const ImageView& view : views) {
      mean += view.pixels().rowwise().sum();
      count += static_cast<double>(view.pixels().cols());
    }
    mean /= count;
    for (const ImageView& view : views) {
      squares += (view.pixels().colwise() - mean).squaredNorm();
    }
    size = std::sqrt(squares / count);
  }
  Vector2d mean = Vector2d::Zero();
  double size = 1;
};

// h_i' B h_j by (B11, B22, B33, B13, B23), B12 = 0.
Eigen::RowVectorXd Product(const Vector3d& h, const Vector3d& k) {
  Eigen::RowVectorXd row(5);
  row << h[0] * k[0], h[1] * k[1], h[2] * k[2], h[0] * k[2] + h[2] * k[0],
      h[1] * k[2] + h[2] * k[1];
  return row;
}

}  // namespace

// Solves Zhang's equations for B by the least singular vector and reads the
// lens from it: up to a factor B = diag(1/fx^2, 1/fy^2, .) with B13 = -cx /
// fx^2 and B23 = -cy / fy^2.
std::optional<PinholeCamera> StartOfLens(const std::vector<ImageView>& views) {
  const PixelScale scale(views);
  MatrixXd A(2 * static_cast<Eigen::Index>(views.size()), 5);
  for (size_t k = 0; k < views.size(); ++k) {
    const BoardAxes board(views[k].points());
    if (!board.is_flat || !(board.size > 0)) return std::nullopt;
    const auto H =
        Projection(board.own.topRows(2) / board.size,
                   (views[k].pixels().colwise() - scale.mean) / scale.size);
    if (!H) return std::nullopt;
    const Vector3d h1 = H->col(0), h2 = H->col(1);
    const auto row = 2 * static_cast<Eigen::Index>(k);
    A.row(row) = Product(h1, h2);
    A.row(row + 1) = Product(h1, h1) - Product(h2, h2);
  }
  if (A.rows() < 4) return std::nullopt;
  const Eigen::JacobiSVD<MatrixXd> svd(A, Eigen::ComputeFullV);
  if (!(svd.singularValues()[3] > kSecondLens * svd.singularValues()[0])) {
    return std::nullopt;
  }
  const VectorXd b = svd.matrixV().col(4);
  const double cx = -b[3] / b[0], cy = -b[4] / b[1];
  const double rest = b[2] - b[3] * b[3] / b[0] - b[4] * b[4] / b[1];
  PinholeCamera camera;
  camera.fx = scale.size * std::sqrt(rest / b[0]);
  camera.fy = scale.size * std::sqrt(rest / b[1]);
  camera.cx = scale.mean.x() + scale.size * cx;
  camera.cy = scale.mean.y() + scale.size * cy;
  if (!std::isfinite(camera.fx) || !std::isfinite(camera.fy)) {
    return std::nullopt;
  }
  return camera;
}

}  // namespace armcal

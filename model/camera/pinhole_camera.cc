#include "model/camera/pinhole_camera.h"

#include <Eigen/LU>

namespace armcal {

using Eigen::Matrix2d;
using Eigen::Vector2d;
using Eigen::Vector3d;

Vector2d PinholeCamera::Distorted(const Vector2d& xy, Matrix2d* by_xy) const {
  const double x = xy.x(), y = xy.y(), r2 = xy.squaredNorm();
  const double radial = 1 + r2 * (k1 + r2 * (k2 + r2 * k3));
  if (by_xy != nullptr) {
    const double slope = 2 * (k1 + r2 * (2 * k2 + r2 * 3 * k3));
    *by_xy << radial + slope * x * x + 2 * p1 * y + 6 * p2 * x,
        slope * x * y + 2 * p1 * x + 2 * p2 * y,
        slope * x * y + 2 * p1 * x + 2 * p2 * y,
        radial + slope * y * y + 6 * p1 * y + 2 * p2 * x;
  }
  return {x * radial + 2 * p1 * x * y + p2 * (r2 + 2 * x * x),
          y * radial + p1 * (r2 + 2 * y * y) + 2 * p2 * x * y};
}

const char* PinholeCamera::LensName(int k) {
  static constexpr const char* kNames[kLensSize] = {"fx", "fy", "cx", "cy",
                                                    "k1", "k2", "p1", "p2"};
  return kNames[k];
}

PinholeCamera::Lens PinholeCamera::lens() const {
  Lens lens;
  lens << fx, fy, cx, cy, k1, k2, p1, p2;
  return lens;
}

void PinholeCamera::set_lens(const Lens& lens) {
  fx = lens[0], fy = lens[1], cx = lens[2], cy = lens[3];
  k1 = lens[4], k2 = lens[5], p1 = lens[6], p2 = lens[7];
}

Vector2d PinholeCamera::Project(const Vector3d& p,
                                Eigen::Matrix<double, 2, 3>* by_point,
                                ByLens* by_lens) const {
  const Vector2d xy(p.x() / p.z(), p.y() / p.z());
  Matrix2d by_xy;
  const Vector2d seen = Distorted(xy, &by_xy);
  if (by_point != nullptr) {
    Eigen::Matrix<double, 2, 3> of_point;
    of_point << 1 / p.z(), 0, -xy.x() / p.z(), 0, 1 / p.z(), -xy.y() / p.z();
    *by_point = Vector2d(fx, fy).asDiagonal() * by_xy * of_point;
  }
  if (by_lens != nullptr) {
    const double x = xy.x(), y = xy.y(), r2 = xy.squaredNorm();
    by_lens->row(0) << seen.x(), 0, 1, 0, fx * x * r2, fx * x * r2 * r2,
        fx * 2 * x * y, fx * (r2 + 2 * x * x);
    by_lens->row(1) << 0, seen.y(), 0, 1, fy * y * r2, fy * y * r2 * r2,
        fy * (r2 + 2 * y * y), fy * 2 * x * y;
  }
  return {fx * seen.x() + cx, fy * seen.y() + cy};
}

// Newton's method from the ideal lens.
Vector2d PinholeCamera::Normalised(const Vector2d& pixel) const {
  constexpr int kMostSteps = 20;
  constexpr double kSettled = 1e-12;
  const Vector2d seen((pixel.x() - cx) / fx, (pixel.y() - cy) / fy);
  Vector2d xy = seen;
  for (int step = 0; step < kMostSteps; ++step) {
    Matrix2d by_xy;
    const Vector2d error = Distorted(xy, &by_xy) - seen;
    const Vector2d move = by_xy.inverse() * error;
    if (!move.allFinite()) return seen;
    xy -= move;
    if (move.norm() < kSettled) break;
  }
  return xy;
}

}  // namespace armcal

#pragma once

#include <Eigen/Core>

namespace armcal {

// A camera with the lens of Brown (1966), as OpenCV and ROS ("plumb_bob") have
// it: a point p of the camera's frame (z forward, x right, y down, m) is seen,
// with x = p_x / p_z, y = p_y / p_z and r^2 = x^2 + y^2, at
//   x' = x (1 + k1 r^2 + k2 r^4 + k3 r^6) + 2 p1 x y + p2 (r^2 + 2 x^2)
//   y' = y (1 + k1 r^2 + k2 r^4 + k3 r^6) + p1 (r^2 + 2 y^2) + 2 p2 x y
//   u = fx x' + cx,   v = fy y' + cy     (px).
struct PinholeCamera {
  double fx = 0, fy = 0, cx = 0, cy = 0;  // px
  double k1 = 0, k2 = 0, p1 = 0, p2 = 0, k3 = 0;
  int width = 0, height = 0;  // px, of an image; 0: not known

  // The parameters that images tell: fx fy cx cy (px) k1 k2 p1 p2. k3 is what
  // it was: few lenses need it, and few images tell it from k2.
  static constexpr int kLensSize = 8;
  static const char* LensName(int k);
  static const char* LensUnit(int k) { return k < 4 ? "px" : "1"; }
  using Lens = Eigen::Matrix<double, kLensSize, 1>;
  using ByLens = Eigen::Matrix<double, 2, kLensSize>;
  Lens lens() const;
  void set_lens(const Lens& lens);

  // (u, v), px, of a point with p_z > 0; its derivatives by p (px/m) and by the
  // lens if asked.
  Eigen::Vector2d Project(const Eigen::Vector3d& p,
                          Eigen::Matrix<double, 2, 3>* by_point,
                          ByLens* by_lens = nullptr) const;
  // (x, y) of what is seen there: without the lens.
  Eigen::Vector2d Normalised(const Eigen::Vector2d& pixel) const;

 private:
  Eigen::Vector2d Distorted(const Eigen::Vector2d& xy,
                            Eigen::Matrix2d* by_xy) const;
};

}  // namespace armcal

#pragma once

#include <Eigen/Geometry>
#include <cmath>

namespace armcal {

// v + d e with e^2 = 0.
template <class T>
struct Dual {
  T v{}, d{};
  Dual() = default;
  Dual(double x) : v(x) {}  // NOLINT
  Dual(const T& v, const T& d) : v(v), d(d) {}
  friend Dual operator+(const Dual& a, const Dual& b) {
    return {a.v + b.v, a.d + b.d};
  }
  friend Dual operator*(const Dual& a, const Dual& b) {
    return {a.v * b.v, a.v * b.d + a.d * b.v};
  }
};
template <class T>
Dual<T> sin(const Dual<T>& x) {
  using std::sin, std::cos;
  return {sin(x.v), x.d * cos(x.v)};
}
template <class T>
Dual<T> cos(const Dual<T>& x) {
  using std::sin, std::cos;
  return {cos(x.v), x.d * (T(-1.0) * sin(x.v))};
}

using ByParameter = Dual<double>;         // .d: by the parameter
using ByJoint = Dual<Dual<ByParameter>>;  // .d: by a joint's position or by
                                          // time, .v.d or .d.d: by time

// A pose [R p], by rows.
struct DualPose {
  ByJoint m[3][4];

  DualPose() : m{{1., 0., 0., 0.}, {0., 1., 0., 0.}, {0., 0., 1., 0.}} {}
  explicit DualPose(const Eigen::Isometry3d& X) {
    for (int k = 0; k < 12; ++k) m[k / 4][k % 4] = X(k / 4, k % 4);
  }
  DualPose operator*(const DualPose& b) const {
    DualPose c;
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 4; ++j) {
        c.m[i][j] = j == 3 ? m[i][3] : ByJoint(0.);
        for (int k = 0; k < 3; ++k) {
          c.m[i][j] = c.m[i][j] + m[i][k] * b.m[k][j];
        }
      }
    }
    return c;
  }
  void Turn(int axis, const ByJoint& angle) {
    DualPose R;
    const int y = (axis + 1) % 3, z = (axis + 2) % 3;
    R.m[y][y] = R.m[z][z] = cos(angle);
    R.m[z][y] = sin(angle);
    R.m[y][z] = ByJoint(-1.) * R.m[z][y];
    *this = *this * R;
  }
  void Shift(int axis, const ByJoint& by) {
    DualPose X;
    X.m[axis][3] = by;
    *this = *this * X;
  }
};

}  // namespace armcal

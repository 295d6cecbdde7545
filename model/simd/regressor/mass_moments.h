#pragma once

#include "model/simd/regressor/geometry_constants.h"
#include "model/simd/regressor/joint_screws.h"

namespace armcal::simd::ARMCAL_INSTRUCTION_SET {

template <class T>
struct Symmetric3 {
  T xx, xy, xz, yy, yz, zz;
};
template <class T>
ARMCAL_INLINE Vector3<T> operator*(const Symmetric3<T>& m,
                                   const Vector3<T>& v) {
  return {m.xx * v.x + m.xy * v.y + m.xz * v.z,
          m.xy * v.x + m.yy * v.y + m.yz * v.z,
          m.xz * v.x + m.yz * v.y + m.zz * v.z};
}

// Of particles of mass m at x, whichever bodies they belong to: sums over them.
template <class T>
struct MassMoments {
  T mass;                // sum m
  Vector3<T> first;      // sum m x
  Symmetric3<T> second;  // sum m x x'
};

template <class T>
ARMCAL_INLINE MassMoments<T> operator+(const MassMoments<T>& a,
                                       const MassMoments<T>& b) {
  const Symmetric3<T>&s = a.second, &t = b.second;
  return {a.mass + b.mass,
          a.first + b.first,
          {s.xx + t.xx, s.xy + t.xy, s.xz + t.xz, s.yy + t.yy, s.yz + t.yz,
           s.zz + t.zz}};
}

// Of a body whose frame lies so, R_WL and p_WL: in W about Wo.
template <class T>
ARMCAL_INLINE MassMoments<T> MomentsOf(const BodyMoments& body,
                                       const Matrix3<T>& R,
                                       const Vector3<T>& p) {
  const double* s = body.second;
  const auto times_second = [&](const Vector3<T>& row) ARMCAL_LAMBDA {
    return Vector3<T>{row.x * s[0] + row.y * s[1] + row.z * s[2],
                      row.x * s[1] + row.y * s[3] + row.z * s[4],
                      row.x * s[2] + row.y * s[4] + row.z * s[5]};
  };
  const Vector3<T> x = times_second(R.x), y = times_second(R.y),
                   z = times_second(R.z);
  const Vector3<T> about = R * body.first;  // Lo
  const Vector3<T> h = about + Times(body.mass, p);
  return {body.mass + T{},
          h,
          {Dot(x, R.x) + h.x * p.x + p.x * about.x,
           Dot(x, R.y) + h.x * p.y + p.x * about.y,
           Dot(x, R.z) + h.x * p.z + p.x * about.z,
           Dot(y, R.y) + h.y * p.y + p.y * about.y,
           Dot(y, R.z) + h.y * p.z + p.y * about.z,
           Dot(z, R.z) + h.z * p.z + p.z * about.z}};
}

// Their momentum when they all move with a twist: angular, linear.
template <class T>
ARMCAL_INLINE Wrench<T> MomentumOf(const MassMoments<T>& of,
                                   const Screw<T>& twist) {
  const Symmetric3<T>& s = of.second;
  return {twist.angular * (s.xx + s.yy + s.zz) - s * twist.angular +
              Cross(of.first, twist.linear),
          twist.linear * of.mass + Cross(twist.angular, of.first)};
}

}  // namespace armcal::simd::ARMCAL_INSTRUCTION_SET

#pragma once

#include "model/simd/regressor/joint_screws.h"

namespace armcal::simd::ARMCAL_INSTRUCTION_SET {

// How a link's frame accelerates, expressed in it.
template <class T>
struct Acceleration {
  Vector3<T> omega, alpha;  // rad/s, rad/s^2
  Vector3<T> origin;        // m/s^2, relative to free fall
  Matrix3<T> B;             // of a point p: origin + B p
};

template <class T>
ARMCAL_INLINE Acceleration<T> AtRest(const ChainConstants& chain) {
  const Vector3<T> zero = {};
  const Vector3<T> gravity = Constant<T>(chain.gravity);
  return {zero, zero, zero - gravity, {zero, zero, zero}};
}

// From P, and its origin, to L at Fo.
template <class T>
ARMCAL_INLINE void EnterLink(const LinkConstants& link, const Matrix3<T>& E,
                             Acceleration<T>* a) {
  a->origin = E * (a->origin + a->B * link.p_PF);
  a->omega = E * a->omega;
  a->alpha = E * a->alpha;
}

// B of an angular velocity and acceleration.
template <class T>
ARMCAL_INLINE Matrix3<T> AccelerationField(const Vector3<T>& w,
                                           const Vector3<T>& v) {
  const T xx = w.x * w.x, yy = w.y * w.y, zz = w.z * w.z;
  const T xy = w.x * w.y, xz = w.x * w.z, yz = w.y * w.z;
  return {{-(yy + zz), xy - v.z, xz + v.y},
          {xy + v.z, -(xx + zz), yz - v.x},
          {xz - v.y, yz + v.x, -(xx + yy)}};
}

template <class T>
ARMCAL_INLINE void AddJoint(const LinkConstants& link, const T& qd,
                            const T& qdd, Acceleration<T>* a) {
  a->alpha =
      a->alpha + Cross(a->omega, link.angular) * qd + Times(link.angular, qdd);
  a->omega = a->omega + Times(link.angular, qd);
  a->B = AccelerationField(a->omega, a->alpha);
}

// Of Lo relative to Fo, from where it is `offset`.
template <class T>
ARMCAL_INLINE Vector3<T> OffsetAcceleration(const LinkConstants& link,
                                            const Vector3<T>& offset,
                                            const T& qd, const T& qdd,
                                            const Acceleration<T>& a) {
  const Vector3<T> bound = a.B * offset;
  if (link.rotational) return bound;
  return bound + Times(link.axis, qdd) + Cross(a.omega, link.axis) * (2 * qd);
}

}  // namespace armcal::simd::ARMCAL_INSTRUCTION_SET

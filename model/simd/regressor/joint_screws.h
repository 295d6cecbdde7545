#pragma once

#include "model/simd/regressor/joint_rotation.h"

namespace armcal::simd::ARMCAL_INSTRUCTION_SET {

// How a unit of a joint's velocity moves the present link's frame, expressed in
// it: angular, and linear of its origin.
template <class T>
struct Screw {
  Vector3<T> angular, linear;
};

// To an origin that is moved by p.
template <class T, class Vector>
ARMCAL_INLINE void Shift(const Vector& p, Screw<T>* screw) {
  screw->linear = screw->linear + Cross(screw->angular, p);
}
// From P, and its origin, to L at Fo.
template <class T>
ARMCAL_INLINE void EnterLink(const LinkConstants& link, const Matrix3<T>& E,
                             Screw<T>* screw) {
  Shift(link.p_PF, screw);
  screw->angular = E * screw->angular;
  screw->linear = E * screw->linear;
}
// The link's own joint's, in L at Fo.
template <class T>
ARMCAL_INLINE Screw<T> OwnScrew(const LinkConstants& link) {
  return {Constant<T>(link.angular), Constant<T>(link.linear)};
}

template <class T>
struct Wrench {
  Vector3<T> couple, force;  // about the link's origin
};

template <class T>
ARMCAL_INLINE T Power(const Screw<T>& screw, const Wrench<T>& wrench) {
  return Dot(screw.angular, wrench.couple) + Dot(screw.linear, wrench.force);
}

// e x a, with e the unit vector of a first moment.
template <class T>
ARMCAL_INLINE Vector3<T> UnitCross(unsigned moment, const Vector3<T>& a) {
  const T zero = {};
  if (moment & (kHx | kSlidingHx)) return {zero, -a.z, a.y};
  if (moment & (kHy | kSlidingHy)) return {a.z, zero, -a.x};
  return {-a.y, a.x, zero};
}

}  // namespace armcal::simd::ARMCAL_INSTRUCTION_SET

#pragma once

#include "model/simd/link_acceleration.h"

namespace armcal::simd::ARMCAL_INSTRUCTION_SET {

// The wrenches that a unit of each moment of a link's needs to move as it does.
// `at`: of the link's frame.

// Second moments: I alpha + omega x I omega, in the order of their bits.
template <class T>
ARMCAL_INLINE void SetCouples(unsigned moments, const Acceleration<T>& at,
                              Vector3<T>* couple) {
  const Vector3<T>&w = at.omega, &v = at.alpha;
  const T xx = w.x * w.x, yy = w.y * w.y, zz = w.z * w.z;
  const T xy = w.x * w.y, xz = w.x * w.z, yz = w.y * w.z;
  if (moments & kIxx) *couple++ = {v.x, xz, -xy};
  if (moments & kIxy) *couple++ = {v.y - xz, v.x + yz, xx - yy};
  if (moments & kIyy) *couple++ = {-yz, v.y, xy};
  if (moments & kIxz) *couple++ = {v.z + xy, zz - xx, v.x - yz};
  if (moments & kIyz) *couple++ = {yy - zz, v.z - xy, v.y + xz};
  if (moments & kIzz) *couple++ = {yz, -xz, v.z};
  if (moments & kIxxMinusIyy) *couple++ = {v.x + yz, xz - v.y, -2 * xy};
  if (moments & kIzzOfJoint) *couple++ = {yz, -xz, v.z};
}

// Column of B along the first moment.
template <class T>
ARMCAL_INLINE Vector3<T> UnitColumn(unsigned moment, const Matrix3<T>& B) {
  if (moment & (kHx | kSlidingHx)) return Column(B, 0);
  if (moment & (kHy | kSlidingHy)) return Column(B, 1);
  return Column(B, 2);
}

// Mass and first moments, in the order of their bits. Those of a sliding link
// are for its own row, where only forces count.
template <class T>
ARMCAL_INLINE void SetWrenches(unsigned moments, const Acceleration<T>& at,
                               const Vector3<T>& offset_acceleration,
                               Wrench<T>* wrench) {
  const Vector3<T> none = {};
  if (moments & kMass) *wrench++ = {none, at.origin};
  for (unsigned h = kHx; h <= kHz; h *= 2) {
    if (moments & h) {
      *wrench++ = {UnitCross(h, at.origin), UnitColumn(h, at.B)};
    }
  }
  if (moments & kSlidingMass) {
    *wrench++ = {none, at.origin + offset_acceleration};
  }
  for (unsigned h = kSlidingHx; h <= kSlidingHz; h *= 2) {
    if (moments & h) *wrench++ = {none, UnitColumn(h, at.B)};
  }
}

// Takes away what the same inertia needs that is attached to the link before,
// at q = 0 of a revolute joint and at Fo of a prismatic one.
template <class T>
ARMCAL_INLINE void Regroup(const LinkConstants& link, const Acceleration<T>& at,
                           const Vector3<T>& offset,
                           const Vector3<T>& offset_acceleration, const T& qd,
                           const T& qdd, Vector3<T>* couples,
                           Wrench<T>* wrench) {
  if (link.moments & kIzzOfJoint) {
    couples[link.num_couples - 1] = {at.omega.y * qd, -(at.omega.x * qd), qdd};
  }
  const Vector3<T> none = {};
  if (link.moments & kSlidingMass) {
    *wrench++ = {Cross(offset, at.origin + offset_acceleration),
                 offset_acceleration};
  }
  for (unsigned h = kSlidingHx; h <= kSlidingHz; h *= 2) {
    if (link.moments & h) {
      *wrench++ = {UnitCross(h, offset_acceleration) +
                       Cross(offset, UnitColumn(h, at.B)),
                   none};
    }
  }
}

// A unit of an unknown length in the present link's frame, and the acceleration
// that it gives to what lies behind it.
template <class T>
struct LengthAcceleration {
  Vector3<T> unit, acceleration;
};

// From P to L; `at` is still of P.
template <class T>
ARMCAL_INLINE void EnterLink(const ChainConstants& chain, int i,
                             const Matrix3<T>& E, const Acceleration<T>& at,
                             LengthAcceleration<T>* lengths) {
  for (int u = 0; u < chain.num_lengths; ++u) {
    const LengthConstants& length = chain.lengths[u];
    if (length.link + 1 == i) {
      lengths[u] = {Column(E, length.component),
                    E * Column(at.B, length.component)};
    } else if (length.link + 1 < i) {
      lengths[u] = {E * lengths[u].unit, E * lengths[u].acceleration};
    }
  }
}

// A column of a moment times a length has no forces: couples for the rows of
// joints before the length and behind it, and the value in its own row.
template <class T>
struct LengthCouples {
  Vector3<T> before, behind;
  T own;
};

template <class T>
ARMCAL_INLINE LengthCouples<T> CouplesOf(
    const LinkConstants& link, unsigned moment,
    const LengthAcceleration<T>& length, const Acceleration<T>& at,
    const Vector3<T>& offset, const Vector3<T>& offset_acceleration) {
  const Vector3<T> axis = Constant<T>(link.axis);
  LengthCouples<T> c;
  if (link.rotational) {
    c.behind = UnitCross(moment, length.acceleration);
    c.before = c.behind + Cross(length.unit, UnitColumn(moment, at.B));
    c.own = Dot(axis, c.behind);
  } else {
    c.behind = Cross(offset, length.acceleration);
    c.before = c.behind + Cross(length.unit, offset_acceleration);
    c.own = Dot(axis, length.acceleration);
  }
  return c;
}

}  // namespace armcal::simd::ARMCAL_INSTRUCTION_SET

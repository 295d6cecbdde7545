#pragma once

#include "model/simd/joint_screws.h"

namespace armcal::simd::ARMCAL_INSTRUCTION_SET {

// How a link's frame moves, and gravity, expressed in it.
template <class T>
struct Velocity {
  Vector3<T> omega;    // rad/s
  Vector3<T> origin;   // m/s
  Vector3<T> gravity;  // m/s^2
};

// From P, and its origin, to L at Fo.
template <class T>
ARMCAL_INLINE void EnterLink(const LinkConstants& link, const Matrix3<T>& E,
                             Velocity<T>* at) {
  at->origin = E * (at->origin + Cross(at->omega, link.p_PF));
  at->omega = E * at->omega;
  at->gravity = E * at->gravity;
}

// The momentum of a unit of a moment, and the wrench of gravity on it, which of
// second moments is none and of the mass a force only.
template <class T>
struct MomentumWrench {
  Wrench<T> momentum;
  Vector3<T> gravity_couple;
};

// Second moments: I omega, in the order of their bits.
template <class T>
ARMCAL_INLINE void SetMomentumCouples(unsigned moments, const Vector3<T>& w,
                                      Vector3<T>* couple) {
  const T zero = {};
  if (moments & kIxx) *couple++ = {w.x, zero, zero};
  if (moments & kIxy) *couple++ = {w.y, w.x, zero};
  if (moments & kIyy) *couple++ = {zero, w.y, zero};
  if (moments & kIxz) *couple++ = {w.z, zero, w.x};
  if (moments & kIyz) *couple++ = {zero, w.z, w.y};
  if (moments & kIzz) *couple++ = {zero, zero, w.z};
  if (moments & kIxxMinusIyy) *couple++ = {w.x, -w.y, zero};
  if (moments & kIzzOfJoint) *couple++ = {zero, zero, w.z};
}

// omega x e, with e the unit vector of the first moment.
template <class T>
ARMCAL_INLINE Vector3<T> CrossUnit(const Vector3<T>& omega, unsigned moment) {
  const Vector3<T> none = {};
  return none - UnitCross(moment, omega);
}

// Mass and first moments, in the order of their bits. Those of a sliding link
// are for its own row, where only forces count.
template <class T>
ARMCAL_INLINE void SetMomentumWrenches(unsigned moments, const Velocity<T>& at,
                                       const Vector3<T>& offset_velocity,
                                       MomentumWrench<T>* wrench) {
  const Vector3<T> none = {};
  if (moments & kMass) *wrench++ = {{none, at.origin}, none};
  for (unsigned h = kHx; h <= kHz; h *= 2) {
    if (moments & h) {
      *wrench++ = {{UnitCross(h, at.origin), CrossUnit(at.omega, h)},
                   UnitCross(h, at.gravity)};
    }
  }
  if (moments & kSlidingMass) {
    *wrench++ = {{none, at.origin + offset_velocity}, none};
  }
  for (unsigned h = kSlidingHx; h <= kSlidingHz; h *= 2) {
    if (moments & h) *wrench++ = {{none, CrossUnit(at.omega, h)}, none};
  }
}

// Takes away the momentum of the same inertia attached to the link before, at
// q = 0 of a revolute joint and at Fo of a prismatic one.
template <class T>
ARMCAL_INLINE void RegroupMomentum(const LinkConstants& link,
                                   const Velocity<T>& at,
                                   const Vector3<T>& offset,
                                   const Vector3<T>& offset_velocity,
                                   const T& qd, Vector3<T>* couples,
                                   MomentumWrench<T>* wrench) {
  const T zero = {};
  const Vector3<T> none = {};
  if (link.moments & kIzzOfJoint) {
    couples[link.num_couples - 1] = {zero, zero, qd};
  }
  if (link.moments & kSlidingMass) {
    *wrench++ = {{Cross(offset, at.origin + offset_velocity), offset_velocity},
                 Cross(offset, at.gravity)};
  }
  for (unsigned h = kSlidingHx; h <= kSlidingHz; h *= 2) {
    if (link.moments & h) {
      *wrench++ = {{UnitCross(h, offset_velocity) +
                        Cross(offset, CrossUnit(at.omega, h)),
                    none},
                   none};
    }
  }
}

// A unit of an unknown length in the present link's frame, and the velocity
// that it gives to what lies behind it.
template <class T>
struct LengthVelocity {
  Vector3<T> unit, velocity;
};

// From P to L; `omega` is still of P.
template <class T>
ARMCAL_INLINE void EnterLink(const ChainConstants& chain, int i,
                             const Matrix3<T>& E, const Vector3<T>& omega,
                             LengthVelocity<T>* lengths) {
  for (int u = 0; u < chain.num_lengths; ++u) {
    const LengthConstants& length = chain.lengths[u];
    if (length.link + 1 == i) {
      lengths[u].unit = Column(E, length.component);
      lengths[u].velocity = Cross(E * omega, lengths[u].unit);
    } else if (length.link + 1 < i) {
      lengths[u] = {E * lengths[u].unit, E * lengths[u].velocity};
    }
  }
}

// A column of a moment times a length has no forces: couples for the rows of
// joints before the length and behind it; what the frame's change gives to
// those behind; and the values in its own row.
template <class T>
struct LengthMomentum {
  Vector3<T> before, behind, change;
  T own_P, own_D;
};

template <class T>
ARMCAL_INLINE LengthMomentum<T> MomentumOf(const LinkConstants& link,
                                           unsigned moment,
                                           const LengthVelocity<T>& length,
                                           const Velocity<T>& at,
                                           const Vector3<T>& offset,
                                           const Vector3<T>& offset_velocity) {
  const Vector3<T> axis = Constant<T>(link.axis);
  const Vector3<T> axis_rate = Cross(at.omega, link.axis);
  const Vector3<T> linear =
      link.rotational ? CrossUnit(at.omega, moment) : offset_velocity;
  LengthMomentum<T> m;
  m.behind = link.rotational ? UnitCross(moment, length.velocity)
                             : Cross(offset, length.velocity);
  m.before = m.behind + Cross(length.unit, linear);
  m.change = Cross(linear, length.velocity);
  if (link.rotational) {
    m.own_P = Dot(axis, m.behind);
    m.own_D = Dot(axis_rate, m.behind) + Dot(axis, m.change);
  } else {
    m.own_P = Dot(axis, length.velocity);
    m.own_D = Dot(axis_rate, length.velocity);
  }
  return m;
}

}  // namespace armcal::simd::ARMCAL_INSTRUCTION_SET

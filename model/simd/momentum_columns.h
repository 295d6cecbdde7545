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

// A joint's screw S and V x S, with V the twist of its link. With h a link's
// momentum, dL/dqd is S . h, and dL/dq is (V x S) . h + S . (its weight).
template <class T>
struct MovingScrew {
  Screw<T> screw, change;
};

// Of the link's own joint at Fo.
template <class T>
ARMCAL_INLINE MovingScrew<T> OwnMovingScrew(const LinkConstants& link,
                                            const Velocity<T>& at) {
  const Vector3<T> rate = Cross(at.omega, link.axis), none = {};
  if (!link.rotational) return {OwnScrew<T>(link), {none, rate}};
  return {OwnScrew<T>(link), {rate, Cross(at.origin, link.axis)}};
}

// One row's columns of one link: where the next go.
struct MomentumWriter {
  double *P, *D;
  long stride;
  const int* place;

  template <class T>
  ARMCAL_INLINE void Write(const T& of_P, const T& of_D) {
    const long at = *place++ * stride;
    StoreAs(of_P, P + at);
    StoreAs(of_D, D + at);
  }
};

// Along `s` the angular momentum I w of a unit of the second moment; that of
// kIzzOfJoint is given.
template <class T>
ARMCAL_INLINE T Along(unsigned moment, const Vector3<T>& s, const Vector3<T>& w,
                      const T& izz_of_joint) {
  switch (moment) {
    case kIxx:
      return s.x * w.x;
    case kIxy:
      return s.x * w.y + s.y * w.x;
    case kIyy:
      return s.y * w.y;
    case kIxz:
      return s.x * w.z + s.z * w.x;
    case kIyz:
      return s.y * w.z + s.z * w.y;
    case kIzz:
      return s.z * w.z;
    case kIxxMinusIyy:
      return s.x * w.x - s.y * w.y;
    default:
      return s.z * izz_of_joint;
  }
}

// The row of a joint. A unit of first moment along e has the momentum omega x
// e, the angular momentum e x v of the origin's velocity v, and the weight's
// couple e x g.
template <class T>
ARMCAL_INLINE void WriteMoments(unsigned moments, const Velocity<T>& at,
                                const T& izz_of_joint,
                                const MovingScrew<T>& joint,
                                MomentumWriter* to) {
  const Screw<T>&S = joint.screw, &C = joint.change;
  const Vector3<T>& w = at.omega;
#pragma GCC unroll 8
  for (unsigned moment = kIxx; moment < kMass; moment *= 2) {
    if (!(moments & moment)) continue;
    to->Write(Along(moment, S.angular, w, izz_of_joint),
              Along(moment, C.angular, w, izz_of_joint));
  }
  if (moments & kMass) {
    to->Write(Dot(S.linear, at.origin),
              Dot(C.linear, at.origin) + Dot(S.linear, at.gravity));
  }
  const Vector3<T> P = Cross(at.origin, S.angular) + Cross(S.linear, w);
  const Vector3<T> D = Cross(at.origin, C.angular) + Cross(C.linear, w) +
                       Cross(at.gravity, S.angular);
  if (moments & kHx) to->Write(P.x, D.x);
  if (moments & kHy) to->Write(P.y, D.y);
  if (moments & kHz) to->Write(P.z, D.z);
}

// Where samples' rows are.
struct MomentumOutput {
  double *const *P, *const *D;
  long offset, stride;

  MomentumWriter Row(const LinkConstants& link, int k, int column) const {
    return {P[k] + offset, D[k] + offset, stride,
            PlacesOfRow(link, k) + column};
  }
};

// The columns of link i's moments that do not slide, in rows 0 to i; kMoments:
// which these are, 0: only `link` knows.
template <unsigned kMoments, class T>
ARMCAL_INLINE void WriteColumns(const LinkConstants& link, int i,
                                const Velocity<T>& at,
                                const MovingScrew<T>* joints, const T& qd,
                                const MomentumOutput& out) {
  const unsigned moments = kMoments != 0 ? kMoments : link.moments;
  MomentumWriter own = out.Row(link, i, 0);
  WriteMoments(moments, at, at.omega.z, joints[i], &own);
  for (int k = 0; k < i; ++k) {
    MomentumWriter to = out.Row(link, k, 0);
    WriteMoments(moments, at, qd, joints[k], &to);
  }
}

}  // namespace armcal::simd::ARMCAL_INSTRUCTION_SET

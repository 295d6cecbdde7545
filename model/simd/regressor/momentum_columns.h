#pragma once

#include "model/simd/regressor/joint_screws.h"
#include "model/simd/regressor/row_writer.h"

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

// Where samples' rows are.
struct MomentumOutput {
  double *const *P, *const *D;
  long offset, stride;

  template <bool kAll>
  ARMCAL_INLINE RowWriter<2, kAll> Row(const LinkConstants& link, int k,
                                       int column) const {
    return {
        {P[k] + offset, D[k] + offset}, stride, PlacesOfRow(link, k) + column};
  }
};

// The row of a joint. A unit of first moment along e has the momentum omega x
// e, the angular momentum e x v of the origin's velocity v, and the weight's
// couple e x g.
template <unsigned kMoments, class T, class Writer>
ARMCAL_INLINE void WriteMoments(const Velocity<T>& at, const T& izz_of_joint,
                                const MovingScrew<T>& joint, Writer to) {
  const Screw<T>&S = joint.screw, &C = joint.change;
  const Vector3<T>& w = at.omega;
#pragma GCC unroll 8
  for (unsigned moment = kIxx; moment < kMass; moment *= 2) {
    if (!(kMoments & moment)) continue;
    to.Write(Along(moment, S.angular, w, izz_of_joint),
             Along(moment, C.angular, w, izz_of_joint));
  }
  if (kMoments & kMass) {
    to.Write(Dot(S.linear, at.origin),
             Dot(C.linear, at.origin) + Dot(S.linear, at.gravity));
  }
  const Vector3<T> P = Cross(at.origin, S.angular) + Cross(S.linear, w);
  const Vector3<T> D = Cross(at.origin, C.angular) + Cross(C.linear, w) +
                       Cross(at.gravity, S.angular);
  if (kMoments & kHx) to.Write(P.x, D.x);
  if (kMoments & kHy) to.Write(P.y, D.y);
  if (kMoments & kHz) to.Write(P.z, D.z);
}

// The columns of link i's moments, which do not slide, in rows 0 to i.
template <unsigned kMoments, bool kAll, class T>
ARMCAL_INLINE void WriteColumns(const LinkConstants& link, int i,
                                const Velocity<T>& at,
                                const MovingScrew<T>* joints, const T& qd,
                                const MomentumOutput& out) {
  WriteMoments<kMoments>(at, at.omega.z, joints[i], out.Row<kAll>(link, i, 0));
  for (int k = 0; k < i; ++k) {
    WriteMoments<kMoments>(at, qd, joints[k], out.Row<kAll>(link, k, 0));
  }
}

}  // namespace armcal::simd::ARMCAL_INSTRUCTION_SET

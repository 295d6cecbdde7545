#pragma once

#include "model/simd/motion/body_wrench.h"

namespace armcal::simd::ARMCAL_INSTRUCTION_SET {

// What a unit acceleration of its joint takes of what a body carries, at rest.
template <class T>
ARMCAL_INLINE Wrench<T> UnitWrench(const Moments<T>& body, const T& mass,
                                   bool rotational) {
  const Vector3<T>& h = body.h;
  const T none = {};
  if (rotational) {
    return {{-body.J.xz, -body.J.yz, body.J.xx + body.J.yy}, {-h.y, h.x, none}};
  }
  return {{h.y, -h.x, none}, {none, none, mass}};
}

// Moments of what a body of `mass` carries, with those of the body before.
template <class T>
ARMCAL_INLINE Moments<T> WithParent(const MovedFrame<T>& frame, const T& mass,
                                    const Moments<T>& body,
                                    const Moments<T>& parent) {
  const Vector3<T> h = frame.InParent(body.h);
  const SecondMoment<T> J = frame.InParent(body.J), &to = parent.J;
  const Vector3<T>& p = frame.p;
  const Vector3<T> shifted = h + p * mass;
  return {parent.h + shifted,
          {to.xx + J.xx + (h.x + shifted.x) * p.x,
           to.xy + J.xy + h.x * p.y + p.x * shifted.y,
           to.xz + J.xz + h.x * p.z + p.x * shifted.z,
           to.yy + J.yy + (h.y + shifted.y) * p.y,
           to.yz + J.yz + h.y * p.z + p.y * shifted.z,
           to.zz + J.zz + (h.z + shifted.z) * p.z}};
}

// M(q), of row i the lower triangle at M[n i]: composite rigid bodies.
template <class T>
ARMCAL_INLINE void SetInertia(const ArmConstants& arm,
                              const JointAngle<T>* angles, const T* q, T* M) {
  const int n = arm.num_joints;
  const bool first_turns = arm.joints[0].rotational;
  Moments<T> body = MomentsOf(BodyConstants<T>(arm, n - 1));
  for (int i = n - 1; i > 0; --i) {
    const bool rotational = arm.joints[i].rotational;
    const T mass = BodyConstants<T>(arm, i)[kMassBeyond];
    Wrench<T> wrench = UnitWrench(body, mass, rotational);
    M[n * i + i] = AlongJoint(wrench, rotational);
    for (int j = i - 1; j > 0; --j) {
      wrench = InParent(FrameOf(arm, j + 1, angles, q), wrench);
      M[n * i + j] = AlongJoint(wrench, arm.joints[j].rotational);
    }
    M[n * i] =
        AlongJointBefore(FrameOf(arm, 1, angles, q), wrench, first_turns);
    if (i == 1) break;
    body = WithParent(FrameOf(arm, i, angles, q), mass, body,
                      MomentsOf(BodyConstants<T>(arm, i - 1)));
  }
  const BodyConstants<T> first(arm, 0);
  if (n > 1 && first_turns) {  // nothing else is wanted of what it moves
    body = WithParent(FrameOf(arm, 1, angles, q),
                      BodyConstants<T>(arm, 1)[kMassBeyond], body,
                      MomentsOf(first));
  }
  M[0] = first_turns ? body.J.xx + body.J.yy : first[kMassBeyond];
}

}  // namespace armcal::simd::ARMCAL_INSTRUCTION_SET

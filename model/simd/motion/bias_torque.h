#pragma once

#include "model/simd/motion/body_wrench.h"

namespace armcal::simd::ARMCAL_INSTRUCTION_SET {

// How M moves without joint accelerations, in M; of Mo relative to free fall.
// A point p of the body has the acceleration origin + B p.
template <class T>
struct FrameMotion {
  Vector3<T> omega, alpha, origin;
  Matrix3<T> B;
};

template <class T>
ARMCAL_INLINE void SetRates(FrameMotion<T>* m) {
  const Vector3<T>&w = m->omega, &a = m->alpha;
  const T xx = w.x * w.x, yy = w.y * w.y, zz = w.z * w.z;
  m->B = {{-(yy + zz), w.x * w.y - a.z, w.x * w.z + a.y},
          {w.x * w.y + a.z, -(xx + zz), w.y * w.z - a.x},
          {w.x * w.z - a.y, w.y * w.z + a.x, -(xx + yy)}};
}

// From the body before to this one.
template <class T>
ARMCAL_INLINE void EnterBody(const MovedFrame<T>& frame, bool rotational,
                             const T& qd, FrameMotion<T>* m) {
  m->origin = frame.InChild(m->origin + m->B * frame.p);
  m->omega = frame.InChild(m->omega);
  m->alpha = frame.InChild(m->alpha);
  Vector3<T>& turned = rotational ? m->alpha : m->origin;
  const T rate = rotational ? qd : 2 * qd;
  turned.x = turned.x + m->omega.y * rate;
  turned.y = turned.y - m->omega.x * rate;
  if (rotational) m->omega.z = m->omega.z + qd;
  SetRates(m);
}

// The wrench that moves a body so.
template <class T>
ARMCAL_INLINE Wrench<T> WrenchOf(const BodyConstants<T>& body,
                                 const FrameMotion<T>& m) {
  const Matrix3<T>& B = m.B;
  const auto [h, J] = MomentsOf(body);
  const Vector3<T> moment = {B.z.x * J.xy + B.z.y * J.yy + B.z.z * J.yz -
                                 B.y.x * J.xz - B.y.y * J.yz - B.y.z * J.zz,
                             B.x.x * J.xz + B.x.y * J.yz + B.x.z * J.zz -
                                 B.z.x * J.xx - B.z.y * J.xy - B.z.z * J.xz,
                             B.y.x * J.xx + B.y.y * J.xy + B.y.z * J.xz -
                                 B.x.x * J.xy - B.x.y * J.yy - B.x.z * J.yz};
  return {moment + Cross(h, m.origin), m.origin * body[kMassOfBody] + B * h};
}

// Wrenches that the bodies need without joint accelerations. Of the first only
// what acts along its joint is wanted: it turns about z, which needs nothing
// along z, in a field of gravity.
template <class T>
ARMCAL_INLINE void SetWrenches(const ArmConstants& arm,
                               const JointAngle<T>* angles, const T* q,
                               const T* qd, Wrench<T>* wrenches) {
  const T none = {};
  const Vector3<T> zero = {none, none, none};
  const Vector3<T> gravity = {LoadAs<T>(arm.values),
                              LoadAs<T>(arm.values + kWidth<T>),
                              LoadAs<T>(arm.values + 2 * kWidth<T>)};
  FrameMotion<T> m = {
      zero, zero, FrameOf(arm, 0, angles, q).InChild(zero - gravity), {}};
  if (arm.joints[0].rotational) m.omega.z = qd[0];
  const T zz = -(m.omega.z * m.omega.z);
  m.B = {{zz, none, none}, {none, zz, none}, zero};
  const BodyConstants<T> first(arm, 0);
  const T couple = Cross(first.Vector(kFirstMoment), m.origin).z;
  wrenches[0] = {{none, none, couple},
                 {none, none, first[kMassOfBody] * m.origin.z}};
  for (int i = 1; i < arm.num_joints; ++i) {
    EnterBody(FrameOf(arm, i, angles, q), arm.joints[i].rotational, qd[i], &m);
    wrenches[i] = WrenchOf(BodyConstants<T>(arm, i), m);
  }
}

// The torque of all wrenches, each about its own Mo.
template <class T>
ARMCAL_INLINE void SumWrenches(const ArmConstants& arm,
                               const JointAngle<T>* angles, const T* q,
                               const Wrench<T>* wrenches, T* torque) {
  const int n = arm.num_joints;
  Wrench<T> sum = wrenches[n - 1];
  for (int i = n - 1; i > 0; --i) {
    torque[i] = AlongJoint(sum, arm.joints[i].rotational);
    const Wrench<T> wrench = InParent(FrameOf(arm, i, angles, q), sum);
    sum = {wrenches[i - 1].couple + wrench.couple,
           wrenches[i - 1].force + wrench.force};
  }
  torque[0] = AlongJoint(sum, arm.joints[0].rotational);
}

}  // namespace armcal::simd::ARMCAL_INSTRUCTION_SET

#pragma once

#include "model/simd/joint_screws.h"
#include "model/simd/moved_frame.h"

namespace armcal::simd::ARMCAL_INSTRUCTION_SET {

// First and second moments of bodies about Mo, in M.
template <class T>
struct Moments {
  Vector3<T> h;
  SecondMoment<T> J;
};
template <class T>
ARMCAL_INLINE Moments<T> MomentsOf(const BodyConstants<T>& body) {
  const Vector3<T> x = body.Vector(kSecondMoment);
  const Vector3<T> y = body.Vector(kSecondMoment + 3);
  return {body.Vector(kFirstMoment), {x.x, x.y, x.z, y.x, y.y, y.z}};
}

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

template <class T>
ARMCAL_INLINE Wrench<T> InParent(const MovedFrame<T>& frame,
                                 const Wrench<T>& wrench) {
  const Vector3<T> force = frame.InParent(wrench.force);
  return {frame.InParent(wrench.couple) + Cross(frame.p, force), force};
}

template <class T>
ARMCAL_INLINE T AlongJoint(const Wrench<T>& wrench, bool rotational) {
  return rotational ? wrench.couple.z : wrench.force.z;
}

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

// What of a wrench about Mo acts along the joint before.
template <class T>
ARMCAL_INLINE T AlongJointBefore(const MovedFrame<T>& frame,
                                 const Wrench<T>& wrench, bool rotational) {
  return rotational ? InParent(frame, wrench).couple.z
                    : frame.InParent(wrench.force).z;
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

// M(q) and, where qd is given, the torque without acceleration: recursive
// Newton-Euler (Featherstone 2008, sections 6.2 and 5.3).
template <class T>
ARMCAL_INLINE void JointSpaceTerms(const ArmConstants& arm, const T* q,
                                   const T* qd, T* M, T* bias) {
  auto* angles = ARMCAL_SCRATCH(JointAngle<T>, arm.num_joints);
  SetAngles(arm, q, angles);
  if (qd != nullptr) {
    auto* wrenches = ARMCAL_SCRATCH(Wrench<T>, arm.num_joints);
    SetWrenches(arm, angles, q, qd, wrenches);
    SumWrenches(arm, angles, q, wrenches, bias);
  }
  SetInertia(arm, angles, q, M);
}

}  // namespace armcal::simd::ARMCAL_INSTRUCTION_SET

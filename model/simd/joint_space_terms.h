#pragma once

#include "model/simd/joint_screws.h"
#include "model/simd/moved_frame.h"

namespace armcal::simd::ARMCAL_INSTRUCTION_SET {

// One body on the way out and back: its frame, the wrench about Mo that it and
// all beyond it need without joint accelerations, and the mass of all these.
template <class T>
struct BodyState {
  Wrench<T> wrench;
  Vector3<T> h;
  SecondMoment<T> J;
};

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
ARMCAL_INLINE Wrench<T> WrenchOf(const T& mass, const Vector3<T>& h,
                                 const SecondMoment<T>& J,
                                 const FrameMotion<T>& m) {
  const Matrix3<T>& B = m.B;
  const Vector3<T> moment = {B.z.x * J.xy + B.z.y * J.yy + B.z.z * J.yz -
                                 B.y.x * J.xz - B.y.y * J.yz - B.y.z * J.zz,
                             B.x.x * J.xz + B.x.y * J.yz + B.x.z * J.zz -
                                 B.z.x * J.xx - B.z.y * J.xy - B.z.z * J.xz,
                             B.y.x * J.xx + B.y.y * J.xy + B.y.z * J.xz -
                                 B.x.x * J.xy - B.x.y * J.yy - B.x.z * J.yz};
  return {moment + Cross(h, m.origin), m.origin * mass + B * h};
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
ARMCAL_INLINE Wrench<T> UnitWrench(const BodyState<T>& body, const T& mass,
                                   bool rotational) {
  const Vector3<T>& h = body.h;
  const T none = {};
  if (rotational) {
    return {{-body.J.xz, -body.J.yz, body.J.xx + body.J.yy}, {-h.y, h.x, none}};
  }
  return {{h.y, -h.x, none}, {none, none, mass}};
}

// Adds what a body of `mass` carries to the body before.
template <class T>
ARMCAL_INLINE void AddToParent(const MovedFrame<T>& frame, const T& mass,
                               const BodyState<T>& body, BodyState<T>* parent) {
  const Vector3<T> h = frame.InParent(body.h);
  const SecondMoment<T> J = frame.InParent(body.J);
  const Vector3<T>& p = frame.p;
  const Vector3<T> shifted = h + p * mass;
  parent->h = parent->h + shifted;
  SecondMoment<T>& to = parent->J;
  to.xx = to.xx + J.xx + (h.x + shifted.x) * p.x;
  to.yy = to.yy + J.yy + (h.y + shifted.y) * p.y;
  to.zz = to.zz + J.zz + (h.z + shifted.z) * p.z;
  to.xy = to.xy + J.xy + h.x * p.y + p.x * shifted.y;
  to.xz = to.xz + J.xz + h.x * p.z + p.x * shifted.z;
  to.yz = to.yz + J.yz + h.y * p.z + p.y * shifted.z;
}

template <class T>
ARMCAL_INLINE void SetBodies(const ArmConstants& arm,
                             const MovedFrame<T>* frames, const T* qd,
                             BodyState<T>* bodies) {
  const T none = {};
  const Vector3<T> zero = {none, none, none};
  FrameMotion<T> m = {zero, zero, {}, {zero, zero, zero}};
  m.origin = {-LoadAs<T>(arm.values), -LoadAs<T>(arm.values + kWidth<T>),
              -LoadAs<T>(arm.values + 2 * kWidth<T>)};
  for (int i = 0; i < arm.num_joints; ++i) {
    const BodyConstants<T> constants(arm, i);
    BodyState<T>& body = bodies[i];
    body.h = constants.Vector(kFirstMoment);
    const int J = kSecondMoment;
    body.J = {constants[J],     constants[J + 1], constants[J + 2],
              constants[J + 3], constants[J + 4], constants[J + 5]};
    if (qd == nullptr) continue;
    EnterBody(frames[i], arm.joints[i].rotational, qd[i], &m);
    body.wrench = WrenchOf(constants[kMassOfBody], body.h, body.J, m);
  }
}

// M(q), row i at M[n i] (both triangles where `whole`, else the lower), and,
// where qd is given, the torque without acceleration: composite rigid bodies
// and recursive Newton-Euler (Featherstone 2008, sections 6.2 and 5.3).
template <class T>
ARMCAL_INLINE void JointSpaceTerms(const ArmConstants& arm, const T* q,
                                   const T* qd, T* M, T* bias) {
  const int n = arm.num_joints;
  auto* frames = ARMCAL_SCRATCH(MovedFrame<T>, n);
  auto* bodies = ARMCAL_SCRATCH(BodyState<T>, n);
  SetFrames(arm, q, frames);
  SetBodies(arm, frames, qd, bodies);
  for (int i = n - 1; i >= 0; --i) {
    const BodyState<T>& body = bodies[i];
    const T mass = BodyConstants<T>(arm, i)[kMassBeyond];
    if (qd != nullptr) {
      bias[i] = AlongJoint(body.wrench, arm.joints[i].rotational);
      if (i > 0) {
        const Wrench<T> wrench = InParent(frames[i], body.wrench);
        Wrench<T>& to = bodies[i - 1].wrench;
        to = {to.couple + wrench.couple, to.force + wrench.force};
      }
    }
    Wrench<T> wrench = UnitWrench(body, mass, arm.joints[i].rotational);
    M[n * i + i] = AlongJoint(wrench, arm.joints[i].rotational);
    for (int j = i - 1; j >= 0; --j) {
      wrench = InParent(frames[j + 1], wrench);
      M[n * i + j] = AlongJoint(wrench, arm.joints[j].rotational);
    }
    if (i > 0) AddToParent(frames[i], mass, body, &bodies[i - 1]);
  }
}

}  // namespace armcal::simd::ARMCAL_INSTRUCTION_SET

#pragma once

#include "model/simd/lanes/hyperbolic_tangent.h"
#include "model/simd/motion/moved_frame.h"

namespace armcal::simd::ARMCAL_INSTRUCTION_SET {

template <class T>
ARMCAL_INLINE T Clamped(const T& x) {
  const T one = T{} + 1;
  const T above = x > -one ? x : -one;
  return above < one ? above : one;
}

// tanh of as many as there are joints.
ARMCAL_INLINE void HyperbolicTangents(int n, Lanes* x) {
  for (int j = 0; j < n; ++j) x[j] = HyperbolicTangent(x[j]);
}
ARMCAL_INLINE void HyperbolicTangents(int n, double* x) {
  HyperbolicTangentOfAll(x, 1, n, x);
}

// The state c of each joint's Coulomb friction at (q, qd), where displacement
// laws have theirs from `coulomb` at q0. Joints without any: not set.
template <class T>
ARMCAL_INLINE void CoulombFriction(const ArmConstants& arm, const T* q0,
                                   const T* coulomb, const T* q, const T* qd,
                                   T* c) {
  bool has_velocity_laws = false;
  for (int j = 0; j < arm.num_joints; ++j) {
    const T inverse_width = BodyConstants<T>(arm, j)[kInverseWidth];
    const bool velocity = arm.joints[j].transition == Transition::kVelocity;
    has_velocity_laws |= velocity;
    c[j] = (velocity ? qd[j] : q[j] - q0[j]) * inverse_width;
  }
  if (has_velocity_laws) {
    auto* tanh = ARMCAL_SCRATCH(T, arm.num_joints);
    for (int j = 0; j < arm.num_joints; ++j) tanh[j] = c[j];
    HyperbolicTangents(arm.num_joints, tanh);
    for (int j = 0; j < arm.num_joints; ++j) {
      if (arm.joints[j].transition == Transition::kVelocity) c[j] = tanh[j];
    }
  }
  for (int j = 0; j < arm.num_joints; ++j) {
    if (arm.joints[j].transition != Transition::kDisplacement) continue;
    c[j] = Clamped(coulomb[j] + c[j]);
  }
}

// What friction, offset and spring of joint j take of its torque.
template <class T>
ARMCAL_INLINE T JointTermTorque(const ArmConstants& arm, int j, const T& q,
                                const T& qd, const T& c) {
  const BodyConstants<T> joint(arm, j);
  T torque = joint[kOffset] + joint[kViscous] * qd;
  if (arm.joints[j].transition != Transition::kNone) {
    torque = torque + joint[kCoulomb] * c;
  }
  if (arm.joints[j].has_spring) {
    torque = torque + joint[kStiffness] * (q - joint[kRest]);
  }
  return torque;
}

// How fast that grows with velocity and with position, for implicit steps. Of
// tanh the slope from the origin, which is never below its own: so a joint
// that friction stops does not overshoot. Of a Prandtl element none while it
// slides on.
template <class T>
struct JointSlope {
  T damping, stiffness;
};
template <class T>
ARMCAL_INLINE JointSlope<T> SlopeOf(const ArmConstants& arm, int j,
                                    const T& coulomb, const T& qd, const T& c) {
  const BodyConstants<T> joint(arm, j);
  const T none = {};
  JointSlope<T> slope = {joint[kViscous], none};
  if (arm.joints[j].has_spring) slope.stiffness = joint[kStiffness];
  const T largest = joint[kCoulomb] * joint[kInverseWidth];
  if (arm.joints[j].transition == Transition::kVelocity) {
    const T speed = qd < 0 ? -qd : qd, size = c < 0 ? -c : c;
    const T secant = joint[kCoulomb] * size / speed;
    // Where tanh is its argument, nothing is divided by nearly nothing.
    slope.damping = slope.damping +
                    (speed * joint[kInverseWidth] < 1e-5 ? largest : secant);
  } else if (arm.joints[j].transition == Transition::kDisplacement) {
    const T size = coulomb < 0 ? -coulomb : coulomb;
    const T sticks = size < 1 ? largest : none;
    slope.stiffness = slope.stiffness + (coulomb * qd < 0 ? largest : sticks);
  }
  return slope;
}

}  // namespace armcal::simd::ARMCAL_INSTRUCTION_SET

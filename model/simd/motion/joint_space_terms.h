#pragma once

#include "model/simd/motion/bias_torque.h"
#include "model/simd/motion/composite_inertia.h"

namespace armcal::simd::ARMCAL_INSTRUCTION_SET {

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

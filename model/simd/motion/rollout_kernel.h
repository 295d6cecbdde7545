#pragma once

#include "model/simd/motion/forward_dynamics_kernel.h"
#include "model/simd/motion/implicit_stages.h"

namespace armcal::simd::ARMCAL_INSTRUCTION_SET {

// Beyond these a state is of no use any more: rad or m, rad/s or m/s.
constexpr double kLostPosition = 1e5, kLostVelocity = 1e7;

// Rates of stage i; the first says whether there are implicit ones.
template <class T>
ARMCAL_INLINE bool Stage(const ArmConstants& arm, double h, int i,
                         const double* tau_begin, const double* tau_end,
                         long stride, bool implicit, const StepScratch<T>& s) {
  const int n = arm.num_joints;
  T *k = s.k[i], *l = s.l[i];
  for (int j = 0; j < n; ++j) {
    s.q[j] = i == 0 ? s.q0[j] : s.q0[j] + (kNode[i] * h) * s.l[i - 1][j];
    s.qd[j] = i == 0 ? s.qd0[j] : s.qd0[j] + (kNode[i] * h) * s.k[i - 1][j];
    l[j] = s.qd[j];
  }
  JointSpaceTermsAt<T>(arm, s.q, s.qd, s.M, s.x);
  AddArmature(arm, s.M);
  if (arm.has_joint_terms) {
    CoulombFriction(arm, s.q0, s.coulomb0, s.q, s.qd, s.c);
  }
  for (int j = 0; j < n; ++j) {
    const T begin = LoadAs<T>(tau_begin + j * stride);
    const T end = LoadAs<T>(tau_end + j * stride);
    k[j] = begin + kNode[i] * (end - begin) - s.x[j] -
           JointTermTorque(arm, j, s.q[j], s.qd[j], s.c[j]);
  }
  const bool chooses = i == 0 && arm.has_joint_terms;
  for (int j = 0; chooses && j < n; ++j) {
    for (int m = 0; m <= j; ++m) s.implicit[n * j + m] = s.M[n * j + m];
  }
  FactorInertia(n, s.M);
  SolveFactored(n, s.M, k);
  if (chooses) implicit = FactorImplicit(arm, h, s);
  if (implicit) MakeImplicit(arm, h, i, s);
  return implicit;
}

ARMCAL_INLINE unsigned BitsOf(double lost) { return lost != 0; }
ARMCAL_INLINE unsigned BitsOf(const Lanes& lost) {
  if (__builtin_expect(All(lost == 0), true)) return 0;
  double numbers[kLanes];
  Store(lost, numbers);
  unsigned bits = 0;
  for (int k = 0; k < kLanes; ++k) bits |= unsigned{numbers[k] != 0} << k;
  return bits;
}

// The parts of a step's scratch, with the state it begins from.
template <class T>
ARMCAL_INLINE StepScratch<T> LoadState(const ArmState& state, int n,
                                       T* scratch) {
  const auto take = [&](int count) ARMCAL_LAMBDA {
    T* taken = scratch;
    scratch += count;
    return taken;
  };
  StepScratch<T> s;
  T** const parts[] = {&s.q0, &s.qd0,     &s.coulomb0,  &s.q, &s.qd,
                       &s.c,  &s.damping, &s.stiffness, &s.x};
  for (T** part : parts) *part = take(n);
  for (int i = 0; i < kStages; ++i) {
    s.k[i] = take(n);
    s.l[i] = take(n);
  }
  s.M = take(n * n);
  s.implicit = take(n * n);
  LoadJoints(n, state.q, state.stride, s.q0);
  LoadJoints(n, state.qd, state.stride, s.qd0);
  LoadJoints(n, state.coulomb, state.stride, s.coulomb0);
  return s;
}

// From the stages' rates to where the step ends, in s.q, s.qd and s.coulomb0;
// not 0 where that is lost.
template <class T>
ARMCAL_INLINE T EndOfStep(const ArmConstants& arm, double h,
                          const StepScratch<T>& s) {
  const T one = T{} + 1;
  T lost = {};
  for (int j = 0; j < arm.num_joints; ++j) {
    T dq = kWeight[0] * s.l[0][j], dqd = kWeight[0] * s.k[0][j];
    for (int i = 1; i < kStages; ++i) {
      dq += kWeight[i] * s.l[i][j];
      dqd += kWeight[i] * s.k[i][j];
    }
    s.q[j] = s.q0[j] + h * dq;
    s.qd[j] = s.qd0[j] + h * dqd;
    if (arm.joints[j].transition == Transition::kDisplacement) {
      const T inverse_width = BodyConstants<T>(arm, j)[kInverseWidth];
      s.coulomb0[j] =
          Clamped(s.coulomb0[j] + (s.q[j] - s.q0[j]) * inverse_width);
    }
    lost = Size(s.q[j]) < kLostPosition ? lost : one;
    lost = Size(s.qd[j]) < kLostVelocity ? lost : one;
  }
  return lost;
}

template <class T>
unsigned AdvanceAt(const ArmConstants& arm, double h, const double* tau_begin,
                   const double* tau_end, const ArmState& state) {
  const int n = arm.num_joints;
  const long stride = state.stride;
  auto* scratch = ARMCAL_SCRATCH(T, (9 + 2 * kStages + 2 * n) * n);
  const StepScratch<T> s = LoadState(state, n, scratch);
  bool implicit = false;
  for (int i = 0; i < kStages; ++i) {
    implicit = Stage(arm, h, i, tau_begin, tau_end, stride, implicit, s);
  }
  const T lost = EndOfStep(arm, h, s), none = {};
  for (int j = 0; j < n; ++j) {
    StoreAs(lost == 0 ? s.q[j] : none, state.q + j * stride);
    StoreAs(lost == 0 ? s.qd[j] : none, state.qd + j * stride);
    StoreAs(lost == 0 ? s.coulomb0[j] : none, state.coulomb + j * stride);
  }
  return BitsOf(lost);
}

template <class T>
constexpr ArmKernels kArmKernels = {static_cast<int>(kWidth<T>), TermsAt<T>,
                                    AccelerationAt<T>, AdvanceAt<T>};

}  // namespace armcal::simd::ARMCAL_INSTRUCTION_SET

#pragma once

#include "model/simd/forward_dynamics_kernel.h"
#include "model/simd/joint_friction.h"

namespace armcal::simd::ARMCAL_INSTRUCTION_SET {

// The classical Runge-Kutta method, whose stages are made implicit in what
// friction and springs of the joints add where these are fast: a W-method
// (Hairer, Wanner, Solving Ordinary Differential Equations II, IV.7). Stage i
// of y' = f(y) is
//   k_i = f(y + h sum_j<i a_ij k_j) + h A sum_j<=i c_ij k_j
// with A = -M^-1 times the joints' slopes at the step's begin, whose factors
// all stages share. The c_ij meet the order conditions for any A up to order 3
// (without such terms the step is the classical one, of order 4) and make it
// A- and L-stable: b'(a + c)^-1 1 = 1.
constexpr int kStages = 4;
constexpr double kNode[kStages] = {0, .5, .5, 1};
constexpr double kWeight[kStages] = {1. / 6, 1. / 3, 1. / 3, 1. / 6};
constexpr double kGamma = .25;  // c_ii
constexpr double kImplicit[kStages][kStages - 1] = {
    {}, {-3. / 20}, {43. / 320, -47. / 64}, {1. / 32, 29. / 96, -1. / 3}};
// What decays by less than this in a step is left to explicit ones, which are
// of order 4 and stable up to 2.7: twice that, as the rate is estimated from
// the joints one by one.
constexpr double kFast = 1.25;
// Beyond these a state is of no use any more: rad or m, rad/s or m/s.
constexpr double kLostPosition = 1e5, kLostVelocity = 1e7;

// Scratch of a step; n numbers each.
template <class T>
struct StepScratch {
  const T *q0, *qd0, *coulomb0;
  T *q, *qd, *c;               // of a stage
  T *M, *implicit;             // n x n: factors of M, and of M - h c_ii M A
  T *damping, *stiffness;      // slopes at the begin
  T *k[kStages], *l[kStages];  // rates of qd and q
  T* x;
};

ARMCAL_INLINE bool AnyOf(bool holds) { return holds; }
ARMCAL_INLINE bool AnyOf(const Integers& holds) { return !All(holds == 0); }

// Of the mass matrix in s.implicit, whose factors are s.M: false where it has
// nothing fast. What a lane does is its own: slow ones have no slopes.
template <class T>
ARMCAL_INLINE bool FactorImplicit(const ArmConstants& arm, double h,
                                  const StepScratch<T>& s) {
  const int n = arm.num_joints;
  T speed = {};
  for (int j = 0; j < n; ++j) {
    const JointSlope<T> slope =
        SlopeOf(arm, j, s.coulomb0[j], s.qd0[j], s.c[j]);
    s.damping[j] = slope.damping;
    s.stiffness[j] = slope.stiffness;
    speed +=
        (h * slope.damping + (h * h) * slope.stiffness) * Size(s.M[n * j + j]);
  }
  if (!AnyOf(speed > kFast)) return false;
  const T none = {};
  for (int j = 0; j < n; ++j) {
    s.damping[j] = speed > kFast ? s.damping[j] : none;
    s.stiffness[j] = speed > kFast ? s.stiffness[j] : none;
    s.implicit[n * j + j] += (kGamma * h) * s.damping[j] +
                             (kGamma * h * kGamma * h) * s.stiffness[j];
  }
  FactorInertia(n, s.implicit);
  return true;
}

// From the rates f of stage i, in k and l, to the stage's own.
template <class T>
ARMCAL_INLINE void MakeImplicit(const ArmConstants& arm, double h, int i,
                                const StepScratch<T>& s) {
  const int n = arm.num_joints;
  for (int j = 0; j < n; ++j) {
    T k = kGamma * s.k[i][j], l = kGamma * s.l[i][j];
    for (int m = 0; m < i; ++m) {
      k += kImplicit[i][m] * s.k[m][j];
      l += kImplicit[i][m] * s.l[m][j];
    }
    s.c[j] = k;
    s.x[j] = h * (s.damping[j] * k + s.stiffness[j] * (l + (kGamma * h) * k));
  }
  SolveFactored(n, s.implicit, s.x);
  for (int j = 0; j < n; ++j) {
    s.k[i][j] -= s.x[j];
    // Without a spring the position's rate is the velocity.
    const T none = {}, more = h * (s.c[j] - kGamma * s.x[j]);
    s.l[i][j] += s.stiffness[j] > 0 ? more : none;
  }
}

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
  unsigned bits = 0;
  for (int k = 0; k < kLanes; ++k) bits |= unsigned{lost[k] != 0} << k;
  return bits;
}

template <class T>
unsigned AdvanceAt(const ArmConstants& arm, double h, const double* tau_begin,
                   const double* tau_end, const ArmState& state) {
  const int n = arm.num_joints;
  const long stride = state.stride;
  auto* next = ARMCAL_SCRATCH(T, (9 + 2 * kStages + 2 * n) * n);
  const auto take = [&](int count) ARMCAL_LAMBDA {
    T* taken = next;
    next += count;
    return taken;
  };
  T *q0 = take(n), *qd0 = take(n), *coulomb0 = take(n);
  StepScratch<T> s = {q0,      qd0,         coulomb0,    take(n), take(n),
                      take(n), take(n * n), take(n * n), take(n), take(n),
                      {},      {},          take(n)};
  for (int i = 0; i < kStages; ++i) {
    s.k[i] = take(n);
    s.l[i] = take(n);
  }
  LoadJoints(n, state.q, stride, q0);
  LoadJoints(n, state.qd, stride, qd0);
  LoadJoints(n, state.coulomb, stride, coulomb0);
  bool implicit = false;
  for (int i = 0; i < kStages; ++i) {
    implicit = Stage(arm, h, i, tau_begin, tau_end, stride, implicit, s);
  }
  const T one = T{} + 1;
  T lost = {};
  for (int j = 0; j < n; ++j) {
    T dq = kWeight[0] * s.l[0][j], dqd = kWeight[0] * s.k[0][j];
    for (int i = 1; i < kStages; ++i) {
      dq += kWeight[i] * s.l[i][j];
      dqd += kWeight[i] * s.k[i][j];
    }
    s.q[j] = q0[j] + h * dq;
    s.qd[j] = qd0[j] + h * dqd;
    if (arm.joints[j].transition == Transition::kDisplacement) {
      coulomb0[j] =
          Clamped(coulomb0[j] +
                  (s.q[j] - q0[j]) * BodyConstants<T>(arm, j)[kInverseWidth]);
    }
    lost = Size(s.q[j]) < kLostPosition ? lost : one;
    lost = Size(s.qd[j]) < kLostVelocity ? lost : one;
  }
  const T none = {};
  for (int j = 0; j < n; ++j) {
    StoreAs(lost == 0 ? s.q[j] : none, state.q + j * stride);
    StoreAs(lost == 0 ? s.qd[j] : none, state.qd + j * stride);
    StoreAs(lost == 0 ? coulomb0[j] : none, state.coulomb + j * stride);
  }
  return BitsOf(lost);
}

template <class T>
constexpr ArmKernels kArmKernels = {static_cast<int>(kWidth<T>), TermsAt<T>,
                                    AccelerationAt<T>, AdvanceAt<T>};

}  // namespace armcal::simd::ARMCAL_INSTRUCTION_SET

#pragma once

#include "model/simd/motion/inertia_factor.h"
#include "model/simd/motion/joint_friction.h"

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
// Scratch of a step; n numbers each.
template <class T>
struct StepScratch {
  T *q0, *qd0, *coulomb0;      // at the begin
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

}  // namespace armcal::simd::ARMCAL_INSTRUCTION_SET

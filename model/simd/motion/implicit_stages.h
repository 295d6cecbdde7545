#pragma once

#include "model/simd/motion/inertia_factor.h"
#include "model/simd/motion/joint_friction.h"
#include "model/simd/motion/w_method.h"

namespace armcal::simd::ARMCAL_INSTRUCTION_SET {

// Steps of WMethod that are implicit in what friction and springs of the joints
// add where these are fast: A = -M^-1 times the joints' slopes at the step's
// begin, whose factors all stages share.
constexpr int kStages = WMethod::kStages;
constexpr auto& kNode = WMethod::kNode;
constexpr auto& kWeight = WMethod::kWeight;
constexpr double kGamma = WMethod::kGamma;
constexpr auto& kImplicit = WMethod::kImplicit;
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

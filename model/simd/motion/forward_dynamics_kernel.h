#pragma once

#include "model/simd/motion/inertia_factor.h"
#include "model/simd/motion/joint_space_terms.h"

namespace armcal::simd::ARMCAL_INSTRUCTION_SET {

template <class T>
ARMCAL_INLINE void LoadJoints(int n, const double* from, long stride, T* to) {
  for (int j = 0; j < n; ++j) to[j] = LoadAs<T>(from + j * stride);
}
template <class T>
ARMCAL_INLINE void StoreJoints(int n, const T* from, double* to, long stride) {
  for (int j = 0; j < n; ++j) StoreAs(from[j], to + j * stride);
}

template <class T>
void SumPaths(const ArmConstants& arm, const T* q, const T* qd, T* M, T* bias);

// Called by all others, so that what is large is compiled once.
template <class T>
__attribute__((noinline)) void JointSpaceTermsAt(const ArmConstants& arm,
                                                 const T* q, const T* qd, T* M,
                                                 T* bias) {
  if (arm.num_paths > 0) {
    SumPaths<T>(arm, q, qd, M, bias);
  } else {
    JointSpaceTerms(arm, q, qd, M, bias);
  }
}

template <class T>
void SumPaths(const ArmConstants& arm, const T* q, const T* qd, T* M, T* bias) {
  const int n = arm.num_joints;
  const T none = {};
  auto* at = ARMCAL_SCRATCH(T, 3 * n);
  auto* rows = ARMCAL_SCRATCH(T, n * n);
  for (int k = 0; k < n * n; ++k) M[k] = none;
  for (int j = 0; qd != nullptr && j < n; ++j) bias[j] = none;
  for (int p = 0; p < arm.num_paths; ++p) {
    const ArmPath& path = arm.paths[p];
    const int m = path.chain.num_joints;
    for (int i = 0; i < m; ++i) {
      at[i] = q[path.joints[i]];
      if (qd != nullptr) at[m + i] = qd[path.joints[i]];
    }
    JointSpaceTermsAt<T>(path.chain, at, qd != nullptr ? at + m : nullptr, rows,
                         at + 2 * m);
    for (int i = 0; i < m; ++i) {
      for (int j = 0; j <= i; ++j) {
        M[n * path.joints[i] + path.joints[j]] += rows[m * i + j];
      }
      if (qd != nullptr) bias[path.joints[i]] += at[2 * m + i];
    }
  }
}

template <class T>
void TermsAt(const ArmConstants& arm, const double* q, const double* qd,
             long stride, double* M, double* bias) {
  const int n = arm.num_joints;
  auto* at = ARMCAL_SCRATCH(T, 2 * n);
  auto* rows = ARMCAL_SCRATCH(T, n * n);
  auto* torque = ARMCAL_SCRATCH(T, n);
  LoadJoints(n, q, stride, at);
  if (qd != nullptr) LoadJoints(n, qd, stride, at + n);
  JointSpaceTermsAt<T>(arm, at, qd != nullptr ? at + n : nullptr, rows, torque);
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j <= i; ++j) {
      StoreAs(rows[n * i + j], M + (n * i + j) * stride);
      StoreAs(rows[n * i + j], M + (n * j + i) * stride);
    }
  }
  if (qd != nullptr) StoreJoints(n, torque, bias, stride);
}

template <class T>
ARMCAL_INLINE void AddArmature(const ArmConstants& arm, T* M) {
  const int n = arm.num_joints;
  for (int j = 0; j < n; ++j) {
    M[n * j + j] += BodyConstants<T>(arm, j)[kArmatureOfJoint];
  }
}

template <class T>
void AccelerationAt(const ArmConstants& arm, const double* q, const double* qd,
                    const double* tau, long stride, double* qdd) {
  const int n = arm.num_joints;
  auto* at = ARMCAL_SCRATCH(T, 4 * n);
  auto* M = ARMCAL_SCRATCH(T, n * n);
  T *bias = at + 2 * n, *x = at + 3 * n;
  LoadJoints(n, q, stride, at);
  LoadJoints(n, qd, stride, at + n);
  LoadJoints(n, tau, stride, x);
  JointSpaceTermsAt<T>(arm, at, at + n, M, bias);
  AddArmature(arm, M);
  FactorInertia(n, M);
  for (int j = 0; j < n; ++j) x[j] = x[j] - bias[j];
  SolveFactored(n, M, x);
  StoreJoints(n, x, qdd, stride);
}

}  // namespace armcal::simd::ARMCAL_INSTRUCTION_SET

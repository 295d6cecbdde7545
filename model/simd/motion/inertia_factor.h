#pragma once

#include "model/simd/lanes/lanes.h"

namespace armcal::simd::ARMCAL_INSTRUCTION_SET {

// Of the largest pivot, one that is rounding.
constexpr double kNoInertia = 1e-15;

template <class T>
ARMCAL_INLINE T Size(const T& x) {
  return x < 0 ? -x : x;
}

template <class T>
ARMCAL_INLINE void FactorTriangle(int n, T* M) {
  T least = Size(M[n * n - 1]), largest = least;
  for (int k = n - 1; k >= 0; --k) {
    T* row = M + n * k;
    const T pivot = Size(row[k]);
    least = pivot < least ? pivot : least;
    largest = pivot > largest ? pivot : largest;
    row[k] = 1 / row[k];
    for (int i = k - 1; i >= 0; --i) {
      const T factor = row[i] * row[k];
      for (int j = 0; j <= i; ++j) M[n * i + j] -= factor * row[j];
      row[i] = factor;
    }
  }
  const T none = {};
  // NaN is meant. NOLINTNEXTLINE(misc-redundant-expression)
  M[0] = least > kNoInertia * largest ? M[0] : none / none;
}

// The factors are x's lanes' own, or one number for all.
template <class Factor, class T>
ARMCAL_INLINE void SolveTriangles(int n, const Factor* M, T* x) {
  for (int k = n - 1; k > 0; --k) {
    for (int i = 0; i < k; ++i) x[i] -= M[n * k + i] * x[k];
  }
  for (int k = 0; k < n; ++k) {
    x[k] *= M[n * k + k];
    for (int i = 0; i < k; ++i) x[k] -= M[n * k + i] * x[i];
  }
}

// Makes the lower triangle of a mass matrix (row i at M[n i]) its factors
// L' D L, L with ones on the diagonal, where the reciprocals of D stand: from
// the tip, whose inertia is the smallest, to the base. NaN where no inertia
// resists a joint. Arms of six and seven joints have it in registers.
template <class T>
ARMCAL_INLINE void FactorInertia(int n, T* M) {
  if (n == 6) return FactorTriangle(6, M);
  if (n == 7) return FactorTriangle(7, M);
  FactorTriangle(n, M);
}

// x becomes M^-1 x.
template <class Factor, class T>
ARMCAL_INLINE void SolveFactored(int n, const Factor* M, T* x) {
  if (n == 6) return SolveTriangles(6, M, x);
  if (n == 7) return SolveTriangles(7, M, x);
  SolveTriangles(n, M, x);
}

}  // namespace armcal::simd::ARMCAL_INSTRUCTION_SET

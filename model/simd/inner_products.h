#pragma once

#include "model/simd/lanes.h"

namespace armcal::simd::ARMCAL_INSTRUCTION_SET {

// Sums that fit the registers beside what they are summed from: vectors of A
// times three columns of B.
constexpr int kBlock = kLanes == 8 ? 8 : 4;
constexpr int kColumns = 3;

ARMCAL_INLINE double Sum(const Lanes& x) {
#if ARMCAL_LANES == 8
  const auto half = __builtin_shufflevector(x, x, 0, 1, 2, 3) +
                    __builtin_shufflevector(x, x, 4, 5, 6, 7);
#else
  const auto half = x;
#endif
#if ARMCAL_LANES >= 4
  const auto quarter = __builtin_shufflevector(half, half, 0, 1) +
                       __builtin_shufflevector(half, half, 2, 3);
#else
  const auto quarter = half;
#endif
  return quarter[0] + quarter[1];
}

// products[c * step + a] = a' b of N columns of A and C of B. `rows` is a
// multiple of the lanes; columns lie a stride apart.
template <int N, int C>
ARMCAL_INLINE void BlockProducts(const double* A, long a_stride,
                                 const double* B, long b_stride, long rows,
                                 long step, double* products) {
  Lanes sum[C][N];
  for (int c = 0; c < C; ++c) {
    for (int a = 0; a < N; ++a) sum[c][a] = Lanes{};
  }
  for (long r = 0; r < rows; r += kLanes) {
    Lanes b[C];
    for (int c = 0; c < C; ++c) b[c] = Load(B + c * b_stride + r);
#pragma GCC unroll 8
    for (int a = 0; a < N; ++a) {
      const Lanes x = LoadOnce(A + a * a_stride + r);
      for (int c = 0; c < C; ++c) sum[c][a] += x * b[c];
    }
  }
  for (int c = 0; c < C; ++c) {
    for (int a = 0; a < N; ++a) products[c * step + a] = Sum(sum[c][a]);
  }
}

// The same for any number of columns of A.
template <int C>
ARMCAL_INLINE void ProductsOfAll(const double* A, long a_stride, int count,
                                 const double* B, long b_stride, long rows,
                                 long step, double* products) {
  int a = 0;
  for (; a + kBlock <= count; a += kBlock) {
    BlockProducts<kBlock, C>(A + a * a_stride, a_stride, B, b_stride, rows,
                             step, products + a);
  }
  for (; kBlock > 4 && a + 4 <= count; a += 4) {
    BlockProducts<4, C>(A + a * a_stride, a_stride, B, b_stride, rows, step,
                        products + a);
  }
  for (; a < count; ++a) {
    BlockProducts<1, C>(A + a * a_stride, a_stride, B, b_stride, rows, step,
                        products + a);
  }
}

inline void InnerProducts(const double* A, long a_stride, int a_columns,
                          const double* B, long b_stride, int b_columns,
                          long rows, double* products) {
  int c = 0;
  for (; c + kColumns <= b_columns; c += kColumns) {
    ProductsOfAll<kColumns>(A, a_stride, a_columns, B + c * b_stride, b_stride,
                            rows, a_columns, products + c * a_columns);
  }
  for (; c < b_columns; ++c) {
    ProductsOfAll<1>(A, a_stride, a_columns, B + c * b_stride, b_stride, rows,
                     a_columns, products + c * a_columns);
  }
}

}  // namespace armcal::simd::ARMCAL_INSTRUCTION_SET

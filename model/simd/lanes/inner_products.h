#pragma once

#include "model/simd/lanes/column_pair.h"
#include "model/simd/lanes/horizontal_sums.h"
#include "model/simd/lanes/lanes.h"

namespace armcal::simd::ARMCAL_INSTRUCTION_SET {

// Sums that fit the registers beside what they are summed from: columns of A
// times three columns of B.
constexpr int kBlock = kLanes == 8 ? 8 : 4;
constexpr int kColumns = 3;

// products[c * step + a] = a' b of N columns of A and C of B, added up over the
// pairs. `rows` is a multiple of the lanes.
template <int N, int C, int kPairs>
ARMCAL_INLINE void BlockProducts(const ColumnPair (&pairs)[kPairs], long rows,
                                 long step, double* products) {
  Lanes sum[C * N];
  for (int k = 0; k < C * N; ++k) sum[k] = Lanes{};
  for (long r = 0; r < rows; r += kLanes) {
#pragma GCC unroll 2
    for (int p = 0; p < kPairs; ++p) {
      const ColumnPair& pair = pairs[p];
      Lanes b[C];
      for (int c = 0; c < C; ++c) b[c] = Load(pair.B + c * pair.b_stride + r);
#pragma GCC unroll 8
      for (int a = 0; a < N; ++a) {
        const Lanes x = LoadOnce(pair.A + a * pair.a_stride + r);
        for (int c = 0; c < C; ++c) sum[c * N + a] += x * b[c];
      }
    }
  }
  double sums[kRoomOfSums<C * N>];
  StoreSums(sum, sums);
  for (int c = 0; c < C; ++c) {
    for (int a = 0; a < N; ++a) products[c * step + a] = sums[c * N + a];
  }
}

// The same for `count` columns of A, kBlock of them at a time.
template <int C, int N, int kPairs>
ARMCAL_INLINE void ProductsOfAll(ColumnPair (&pairs)[kPairs], int count,
                                 long rows, long step, double* products) {
  for (; count >= N; count -= N) {
    BlockProducts<N, C>(pairs, rows, step, products);
    for (ColumnPair& pair : pairs) pair.A += N * pair.a_stride;
    products += N;
  }
  if constexpr (N > 1) {
    if (count > 0) {
      ProductsOfAll<C, N - 1>(pairs, count, rows, step, products);
    }
  }
}

template <int C, int kPairs>
ARMCAL_INLINE void ProductsWith(const ColumnPair* pairs, int begin, int count,
                                long rows, double* products) {
  ColumnPair these[kPairs];
  for (int p = 0; p < kPairs; ++p) {
    these[p] = pairs[p];
    these[p].B += begin * these[p].b_stride;
  }
  ProductsOfAll<C, kBlock>(these, count, rows, count, products + begin * count);
}

template <int kPairs>
inline void ProductsOfPairs(const ColumnPair* pairs, int a_columns,
                            int b_columns, long rows, double* products) {
  int c = 0;
  for (; c + kColumns <= b_columns; c += kColumns) {
    ProductsWith<kColumns, kPairs>(pairs, c, a_columns, rows, products);
  }
  for (; c < b_columns; ++c) {
    ProductsWith<1, kPairs>(pairs, c, a_columns, rows, products);
  }
}

inline void InnerProducts(const double* A, long a_stride, int a_columns,
                          const double* B, long b_stride, int b_columns,
                          long rows, double* products) {
  const ColumnPair pair = {A, a_stride, B, b_stride};
  ProductsOfPairs<1>(&pair, a_columns, b_columns, rows, products);
}

// See Kernels::inner_products_of_two.
inline void InnerProductsOfTwo(const ColumnPair* pairs, int a_columns,
                               int b_columns, long rows, double* products) {
  ProductsOfPairs<2>(pairs, a_columns, b_columns, rows, products);
}

}  // namespace armcal::simd::ARMCAL_INSTRUCTION_SET

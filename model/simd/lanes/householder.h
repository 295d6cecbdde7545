#pragma once

#include "model/simd/lanes/inner_products.h"
#include "model/simd/lanes/lanes.h"

namespace armcal::simd::ARMCAL_INSTRUCTION_SET {

// Householder QR of rows below a triangle, like LAPACK's tpqrt: reflection j
// takes column j of the rows into R(j, j). It is I - tau v v' with v = e_j +
// scale * x, x the column as it then is; a panel of them is I - V T V'.
constexpr int kPanel = 8;

struct Panel {
  double scale[kPanel];
  double T[kPanel][kPanel];  // upper triangle
};

// Column J of a panel of N: takes the reflections before it off (w times their
// columns), then gives its products with all columns, of which those behind it
// are as they came; there is room for kPanel.
template <int N, int J>
ARMCAL_INLINE void ReflectAndMultiply(double* X, long stride, long rows,
                                      const double* w, double* products) {
  Lanes sum[N], W[J + 1];
  for (int c = 0; c < N; ++c) sum[c] = Lanes{};
  for (int c = 0; c < J; ++c) W[c] = Broadcast(w[c]);
  for (long r = 0; r < rows; r += kLanes) {
    Lanes x = Load(X + J * stride + r), y[J + 1];
#pragma GCC unroll 8
    for (int c = 0; c < J; ++c) {
      y[c] = LoadOnce(X + c * stride + r);
      x -= W[c] * y[c];
    }
    if (J > 0) Store(x, X + J * stride + r);
#pragma GCC unroll 8
    for (int c = 0; c < J; ++c) sum[c] += x * y[c];
    sum[J] += x * x;
#pragma GCC unroll 8
    for (int c = J + 1; c < N; ++c) sum[c] += x * Load(X + c * stride + r);
  }
  StoreSums(sum, products);
}

// Reflections J.. N - 1 of a panel; R: from its diagonal block on. z[c][b]:
// what reflection b meets in column c, as V'X has it.
template <int N, int J>
ARMCAL_INLINE void FactorPanel(double* R, long r_stride, double* X, long stride,
                               long rows, double (*z)[kPanel], Panel* panel) {
  double products[kPanel], w[J + 1];
  for (int b = 0; b < J; ++b) {
    double t = 0;
    for (int a = 0; a <= b; ++a) t += panel->T[a][b] * z[J][a];
    R[b + J * r_stride] -= t;
    w[b] = t * panel->scale[b];
  }
  ReflectAndMultiply<N, J>(X, stride, rows, w, products);
  const double alpha = R[J + J * r_stride];
  double beta = alpha, tau = 0, scale = 0;
  if (!(products[J] <= 2.2250738585072014e-308)) {  // a NaN passes on
    beta =
        -__builtin_copysign(__builtin_sqrt(alpha * alpha + products[J]), alpha);
    tau = (beta - alpha) / beta;
    scale = 1 / (alpha - beta);
  }
  R[J + J * r_stride] = beta;
  panel->scale[J] = scale;
  panel->T[J][J] = tau;
  for (int c = J + 1; c < N; ++c) {
    z[c][J] = R[J + c * r_stride] + scale * products[c];
  }
  for (int b = 0; b < J; ++b) products[b] *= scale * panel->scale[b];
  for (int a = 0; a < J; ++a) {
    double t = 0;
    for (int b = a; b < J; ++b) t += panel->T[a][b] * products[b];
    panel->T[a][J] = -tau * t;
    panel->T[J][a] = 0;
  }
  if constexpr (J + 1 < N) {
    FactorPanel<N, J + 1>(R, r_stride, X, stride, rows, z, panel);
  }
}

// Takes a panel's reflections off C further columns B, R above them.
template <int C>
ARMCAL_INLINE void Reflect(const Panel& panel, const double* X, long stride,
                           long rows, double* R, long r_stride, double* B) {
  double w[C][kPanel];
  for (int a = 0; a < kPanel; a += kBlock) {
    const ColumnPair pair[] = {{X + a * stride, stride, B, stride}};
    BlockProducts<kBlock, C>(pair, rows, kPanel, &w[0][a]);
  }
  constexpr int kParts = kPanel / kLanes;
  for (int c = 0; c < C; ++c) {
    double* r = R + c * r_stride;
    Lanes t[kParts];
    for (int p = 0; p < kParts; ++p) t[p] = Lanes{};
    for (int a = 0; a < kPanel; ++a) {
      const Lanes z = Broadcast(r[a] + panel.scale[a] * w[c][a]);
      for (int p = 0; p < kParts; ++p) {
        t[p] += Load(panel.T[a] + p * kLanes) * z;
      }
    }
    for (int p = 0; p < kParts; ++p) {
      Store(Load(r + p * kLanes) - t[p], r + p * kLanes);
      Store(t[p] * Load(panel.scale + p * kLanes), w[c] + p * kLanes);
    }
  }
  for (int begin = 0; begin < kPanel; begin += kBlock) {
    Lanes W[C][kBlock];
    for (int c = 0; c < C; ++c) {
      for (int a = 0; a < kBlock; ++a) W[c][a] = Broadcast(w[c][begin + a]);
    }
    const double* V = X + begin * stride;
    for (long r = 0; r < rows; r += kLanes) {
      Lanes b[C];
      for (int c = 0; c < C; ++c) b[c] = Load(B + c * stride + r);
#pragma GCC unroll 8
      for (int a = 0; a < kBlock; ++a) {
        const Lanes x = LoadOnce(V + a * stride + r);
        for (int c = 0; c < C; ++c) b[c] -= x * W[c][a];
      }
      for (int c = 0; c < C; ++c) Store(b[c], B + c * stride + r);
    }
  }
}

template <int N>
inline void FactorLastPanel(int width, double* R, long r_stride, double* X,
                            long stride, long rows, Panel* panel) {
  if (width == N) {
    double z[kPanel][kPanel];
    FactorPanel<N, 0>(R, r_stride, X, stride, rows, z, panel);
  } else if constexpr (N > 1) {
    FactorLastPanel<N - 1>(width, R, r_stride, X, stride, rows, panel);
  }
}

inline void Householder(double* R, long r_stride, int columns, double* X,
                        long stride, long rows, bool triangular) {
  Panel panel;
  for (int j = 0; j < columns; j += kPanel) {
    // Column c of a triangle has c + 1 rows, and keeps them.
    const long used = triangular && j + kPanel < rows ? j + kPanel : rows;
    const int width = columns - j < kPanel ? columns - j : kPanel;
    double* V = X + j * stride;
    FactorLastPanel<kPanel>(width, R + j + j * r_stride, r_stride, V, stride,
                            used, &panel);
    int c = j + kPanel;
    for (; c + kColumns <= columns; c += kColumns) {
      Reflect<kColumns>(panel, V, stride, used, R + j + c * r_stride, r_stride,
                        X + c * stride);
    }
    for (; c < columns; ++c) {
      Reflect<1>(panel, V, stride, used, R + j + c * r_stride, r_stride,
                 X + c * stride);
    }
  }
}

}  // namespace armcal::simd::ARMCAL_INSTRUCTION_SET

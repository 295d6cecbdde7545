#pragma once

#include "model/simd/motion/inertia_factor.h"
#include "model/simd/motion/tangent_step.h"

namespace armcal::simd::ARMCAL_INSTRUCTION_SET {

// Columns `column` and on, as many as there are lanes, of the state's rows, by
// the implicit midpoint rule. `factors`: of the inertia, n x n.
ARMCAL_INLINE void AdvanceColumns(int n, const TangentStep& step,
                                  const double* factors, int column,
                                  Lanes* room, double* state) {
  const long stride = step.stride;
  const double half = step.length / 2;
  Lanes *q = room, *qd = room + n, *rate = room + 2 * n;
  for (int j = 0; j < n; ++j) {
    qd[j] = Load(state + (n + j) * stride + column);
    q[j] = Load(state + j * stride + column) + half * qd[j];
  }
  for (int j = 0; j < n; ++j) {
    Lanes x = Load(step.torque + j * stride + column);
    if (column < step.direct_columns) {
      x -= Load(step.direct + j * step.direct_columns + column);
    }
    for (int k = 0; k < n; ++k) {
      x -= step.by_q[n * j + k] * q[k] + step.by_qd[n * j + k] * qd[k];
    }
    rate[j] = x;
  }
  SolveFactored(n, factors, rate);
  for (int j = 0; j < n; ++j) {
    const Lanes end = qd[j] + step.length * rate[j];
    Store(q[j] + half * end, state + j * stride + column);
    Store(end, state + (n + j) * stride + column);
  }
}

// Takes the derivatives of (q, qd), 2 n rows, through a step. Parameters lie in
// the lanes: a log's steps follow each other, its parameters do not.
inline void AdvanceTangents(const TangentStep& step, double* state) {
  const int n = step.num_joints;
  auto* factors = ARMCAL_SCRATCH(double, n* n);
  for (int k = 0; k < n * n; ++k) factors[k] = step.inertia[k];
  FactorInertia(n, factors);
  auto* room = ARMCAL_SCRATCH(Lanes, 3 * n);
  for (int column = 0; column < step.columns; column += kLanes) {
    if (n == 6) {
      AdvanceColumns(6, step, factors, column, room, state);
    } else {
      AdvanceColumns(n, step, factors, column, room, state);
    }
  }
}

}  // namespace armcal::simd::ARMCAL_INSTRUCTION_SET

#pragma once

#include "model/simd/implicit_stages.h"
#include "model/simd/tangent_step.h"

namespace armcal::simd::ARMCAL_INSTRUCTION_SET {

// Room for one batch of columns of n joints.
struct TangentScratch {
  Lanes *q0, *qd0;          // at the begin
  Lanes *q, *qd, *rate;     // of a stage
  Lanes *sum_q, *sum_rate;  // weighted, of all stages
};

// Columns `column` and on, as many as there are lanes, of the state's rows.
// `factors`: of the stages' inertia, n x n each.
ARMCAL_INLINE void AdvanceColumns(int n, const TangentStep& step,
                                  const double* factors, int column,
                                  const TangentScratch& s, double* state) {
  const long stride = step.stride;
  for (int j = 0; j < n; ++j) {
    s.q0[j] = s.q[j] = Load(state + j * stride + column);
    s.qd0[j] = s.qd[j] = Load(state + (n + j) * stride + column);
    s.sum_q[j] = s.sum_rate[j] = Lanes{};
  }
  for (int i = 0; i < kStages; ++i) {
    const TangentStage& stage = step.stages[i];
    const double* torque = step.torque[(i + 1) / 2];
    const double inner = kNode[i] * step.step;
    for (int j = 0; i > 0 && j < n; ++j) {
      s.q[j] = s.q0[j] + inner * s.qd[j];
      s.qd[j] = s.qd0[j] + inner * s.rate[j];
    }
    for (int j = 0; j < n; ++j) {
      Lanes x = Load(torque + j * stride + column);
      if (column < step.direct_columns) {
        x -= Load(stage.direct + j * step.direct_columns + column);
      }
      for (int k = 0; k < n; ++k) {
        x -= stage.by_q[n * j + k] * s.q[k] + stage.by_qd[n * j + k] * s.qd[k];
      }
      s.rate[j] = x;
    }
    SolveFactored(n, factors + i * n * n, s.rate);
    for (int j = 0; j < n; ++j) {
      s.sum_q[j] += kWeight[i] * s.qd[j];
      s.sum_rate[j] += kWeight[i] * s.rate[j];
    }
  }
  for (int j = 0; j < n; ++j) {
    Store(s.q0[j] + step.step * s.sum_q[j], state + j * stride + column);
    Store(s.qd0[j] + step.step * s.sum_rate[j],
          state + (n + j) * stride + column);
  }
}

// Takes the derivatives of (q, qd), 2 n rows, through a step. Parameters lie in
// the lanes: a log's steps follow each other, its parameters do not.
inline void AdvanceTangents(const TangentStep& step, double* state) {
  const int n = step.num_joints;
  auto* factors = ARMCAL_SCRATCH(double, kStages* n* n);
  for (int i = 0; i < kStages; ++i) {
    double* M = factors + i * n * n;
    for (int k = 0; k < n * n; ++k) M[k] = step.stages[i].inertia[k];
    FactorInertia(n, M);
  }
  auto* room = ARMCAL_SCRATCH(Lanes, 7 * n);
  const TangentScratch s = {room,         room + n,     room + 2 * n,
                            room + 3 * n, room + 4 * n, room + 5 * n,
                            room + 6 * n};
  for (int column = 0; column < step.columns; column += kLanes) {
    if (n == 6) {
      AdvanceColumns(6, step, factors, column, s, state);
    } else {
      AdvanceColumns(n, step, factors, column, s, state);
    }
  }
}

}  // namespace armcal::simd::ARMCAL_INSTRUCTION_SET

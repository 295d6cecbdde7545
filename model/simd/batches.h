#pragma once

#include "model/simd/joint_screws.h"

namespace armcal::simd::ARMCAL_INSTRUCTION_SET {

// Where columns go: column c of row i, sample s to rows[i][c * stride + s].
struct Output {
  double* const* rows;
  long stride;
};

// The samples left over, with others that are 0, in arrays of kLanes.
ARMCAL_INLINE void PadColumns(const double* const* columns, int num_columns,
                              long sample, long left, double* padded,
                              const double** to) {
  for (int j = 0; j < num_columns; ++j) {
    to[j] = padded + j * kLanes;
    for (int s = 0; s < kLanes; ++s) {
      padded[j * kLanes + s] = s < left ? columns[j][sample + s] : 0;
    }
  }
}

// evaluate(motion, sample, outputs) for every kLanes samples. Those left over
// are evaluated in lanes too, so that a sample's results do not depend on which
// batch it is in; nothing is written beyond `count`.
template <int kOutputs, class Evaluate>
ARMCAL_INLINE void ForEachBatch(const ChainConstants& chain,
                                const ChainMotion& motion, long count,
                                const Output (&outputs)[kOutputs],
                                const Evaluate& evaluate) {
  long sample = 0;
  for (; sample + kLanes <= count; sample += kLanes) {
    evaluate(motion, sample, outputs);
  }
  const long left = count - sample;
  if (left <= 0) return;
  const int n = chain.num_links;
  auto* padded = ARMCAL_SCRATCH(double, 3 * n * kLanes);
  auto* columns = ARMCAL_SCRATCH(const double*, 3 * n);
  PadColumns(motion.q, n, sample, left, padded, columns);
  PadColumns(motion.qd, n, sample, left, padded + n * kLanes, columns + n);
  if (motion.qdd != nullptr) {
    PadColumns(motion.qdd, n, sample, left, padded + 2 * n * kLanes,
               columns + 2 * n);
  }
  int size = 0;
  for (int i = 0; i < n; ++i) size += chain.row_sizes[i];
  auto* values = ARMCAL_SCRATCH(double, kOutputs* size* kLanes);
  __builtin_memset(values, 0, kOutputs * size * kLanes * sizeof(double));
  auto* rows = ARMCAL_SCRATCH(double*, kOutputs* n);
  Output padded_outputs[kOutputs];
  double* next = values;
  for (int o = 0; o < kOutputs; ++o) {
    for (int i = 0; i < n; ++i) {
      rows[o * n + i] = next;
      next += chain.row_sizes[i] * kLanes;
    }
    padded_outputs[o] = {rows + o * n, kLanes};
  }
  evaluate({columns, columns + n, columns + 2 * n}, 0, padded_outputs);
  for (int o = 0; o < kOutputs; ++o) {
    for (int i = 0; i < n; ++i) {
      for (int c = 0; c < chain.row_sizes[i]; ++c) {
        for (long s = 0; s < left; ++s) {
          outputs[o].rows[i][c * outputs[o].stride + sample + s] =
              rows[o * n + i][c * kLanes + s];
        }
      }
    }
  }
}

}  // namespace armcal::simd::ARMCAL_INSTRUCTION_SET

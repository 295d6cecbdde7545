#pragma once

#include "model/simd/lanes/lanes.h"
#include "model/simd/regressor/chain_constants.h"

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

// `count` samples of all columns, from where `from` has its `from_sample`.
ARMCAL_INLINE void CopyRows(const ChainConstants& chain, const Output& from,
                            long from_sample, long count, const Output& to,
                            long sample) {
  for (int i = 0; i < chain.num_links; ++i) {
    for (int c = 0; c < chain.row_sizes[i]; ++c) {
      for (long s = 0; s < count; ++s) {
        to.rows[i][c * to.stride + sample + s] =
            from.rows[i][c * from.stride + from_sample + s];
      }
    }
  }
}

// evaluate(motion, sample, outputs) for every kLanes samples. Those left over
// are evaluated in lanes too, so that a sample's results do not depend on which
// batch it is in; nothing is written beyond `count`, and columns that are not
// evaluated stay as they are.
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
  const double* const* const channels[] = {motion.q, motion.qd, motion.qdd};
  for (int k = 0; k < 3 && channels[k] != nullptr; ++k) {
    PadColumns(channels[k], n, sample, left, padded + k * n * kLanes,
               columns + k * n);
  }
  int size = 0;
  for (int i = 0; i < n; ++i) size += chain.row_sizes[i];
  auto* values = ARMCAL_SCRATCH(double, kOutputs* size* kLanes);
  __builtin_memset(values, 0, kOutputs * size * kLanes * sizeof(double));
  auto* rows = ARMCAL_SCRATCH(double*, kOutputs* n);
  Output padded_outputs[kOutputs];
  for (int o = 0; o < kOutputs; ++o) {
    padded_outputs[o] = {rows + o * n, kLanes};
    for (int i = 0; i < n; ++i) {
      rows[o * n + i] = values;
      values += chain.row_sizes[i] * kLanes;
    }
    CopyRows(chain, outputs[o], sample, left, padded_outputs[o], 0);
  }
  evaluate({columns, columns + n, columns + 2 * n}, 0, padded_outputs);
  for (int o = 0; o < kOutputs; ++o) {
    CopyRows(chain, padded_outputs[o], 0, left, outputs[o], sample);
  }
}

}  // namespace armcal::simd::ARMCAL_INSTRUCTION_SET

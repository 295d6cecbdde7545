#pragma once

namespace armcal::simd {

// Columns to be multiplied with each other, a stride apart.
struct ColumnPair {
  const double* A;
  long a_stride;
  const double* B;
  long b_stride;
};

}  // namespace armcal::simd

#pragma once

namespace armcal::simd {

// A second-order section of a recursive filter whose gain at 0 Hz is 1:
// y_k = b (x_k + 2 x_{k-1} + x_{k-2}) - a1 y_{k-1} - a2 y_{k-2}
struct FilterSection {
  double b, a1, a2;
};

}  // namespace armcal::simd

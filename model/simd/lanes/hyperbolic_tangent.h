#pragma once

#include "model/simd/lanes/lanes.h"

namespace armcal::simd::ARMCAL_INSTRUCTION_SET {

// tanh x = t / (t + 2) with t = exp(2 |x|) - 1, to 4 units in the last place.
ARMCAL_INLINE Lanes HyperbolicTangent(const Lanes& x) {
  constexpr double kRound = 6755399441055744.0;  // 1.5 * 2^52
  const Lanes size = x < 0 ? -x : x;
  const Lanes a = size > 20 ? Broadcast(40) : 2 * size;  // 1 - 8e-18 there
  // a = n log 2 + r; the first part of log 2 times n is exact.
  const Lanes shifted = a * 1.44269504088896340736 + kRound;
  const Lanes n = shifted - kRound;
  const Lanes r =
      a - n * 6.93147180369123816490e-1 - n * 1.90821492927058770002e-10;
  // exp(r) - 1 by Taylor's series: |r| < .35.
  Lanes p = r * (1. / 6227020800) + 1. / 479001600;
  p = p * r + 1. / 39916800;
  p = p * r + 1. / 3628800;
  p = p * r + 1. / 362880;
  p = p * r + 1. / 40320;
  p = p * r + 1. / 5040;
  p = p * r + 1. / 720;
  p = p * r + 1. / 120;
  p = p * r + 1. / 24;
  p = p * r + 1. / 6;
  p = p * r + .5;
  p = p * r * r + r;
  const Integers exponent = (Integers)shifted - (Integers)Broadcast(kRound);
  const Lanes power = (Lanes)((exponent + 1023) << 52);
  const Lanes t = power * p + (power - 1);
  const Lanes y = t / (t + 2);
  return x < 0 ? -y : y;
}

// y = tanh(x / width).
inline void HyperbolicTangentOfAll(const double* x, double width, long count,
                                   double* y) {
  long k = 0;
  for (; k + kLanes <= count; k += kLanes) {
    Store(HyperbolicTangent(Load(x + k) / width), y + k);
  }
  Lanes rest = {};
  for (long j = k; j < count; ++j) rest[j - k] = x[j];
  rest = HyperbolicTangent(rest / width);
  for (long j = k; j < count; ++j) y[j] = rest[j - k];
}

}  // namespace armcal::simd::ARMCAL_INSTRUCTION_SET

#pragma once

#include "model/simd/lanes/lanes.h"

namespace armcal::simd::ARMCAL_INSTRUCTION_SET {

// exp(-y) of 0 <= y < 700, to 3e-16: Taylor's polynomial of degree 13 in what
// is left of -y beside whole powers of 2, in Estrin's order.
ARMCAL_INLINE Lanes ExponentialOfMinus(const Lanes& y) {
  constexpr double kRound = 6755399441055744.0;  // 1.5 * 2^52
  const Lanes shifted = y * -1.4426950408889634074 + kRound;
  const Lanes power = shifted - kRound;
  // ln 2 in two parts, the first of which times `power` is exact.
  Lanes r = -y - power * 6.93147180369123816490e-01;
  r = r - power * 1.90821492927058770002e-10;
  const Lanes r2 = r * r, r4 = r2 * r2;
  const Lanes a = (1 + r) + r2 * (.5 + r * (1. / 6));
  const Lanes b =
      (1. / 24 + r * (1. / 120)) + r2 * (1. / 720 + r * (1. / 5040));
  const Lanes c = (1. / 40320 + r * (1. / 362880)) +
                  r2 * (1. / 3628800 + r * (1. / 39916800));
  const Lanes d = 1. / 479001600 + r * (1. / 6227020800.);
  const Lanes x = a + r4 * (b + r4 * (c + r4 * d));
  // The lowest bits of `shifted` hold the power.
  return (Lanes)((Integers)x + ((Integers)shifted << 52));
}

// ln(1 + x) of 0 <= x <= 1, to 3e-16: the series of the inverse hyperbolic
// tangent, about 1 where x is nearer to that than to 0.
ARMCAL_INLINE Lanes LogarithmOfOneAnd(const Lanes& x) {
  const Integers large = x > .41421356237309504880;
  const Lanes m = large ? .5 * (x - 1) : x;
  const Lanes s = m / (2 + m);
  const Lanes z = s * s, z2 = z * z, z4 = z2 * z2;
  const Lanes a = (1 + z * (1. / 3)) + z2 * (1. / 5 + z * (1. / 7));
  const Lanes b = (1. / 9 + z * (1. / 11)) + z2 * (1. / 13 + z * (1. / 15));
  const Lanes c = (1. / 17 + z * (1. / 19)) + z2 * (1. / 21);
  const Lanes log = 2 * s * (a + z4 * (b + z4 * c));
  return large ? log + .69314718055994530942 : log;
}

}  // namespace armcal::simd::ARMCAL_INSTRUCTION_SET

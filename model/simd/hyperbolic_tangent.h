#pragma once

#include "model/simd/lanes.h"

namespace armcal::simd::ARMCAL_INSTRUCTION_SET {

// e^x of 0 <= x <= 700: Moshier's rational function (Cephes, exp.c).
ARMCAL_INLINE Lanes Exponential(const Lanes& x) {
  constexpr double kRound = 6755399441055744.0;  // 1.5 * 2^52
  const Lanes shifted = x * 1.4426950408889634074 + kRound;
  const Lanes power = shifted - kRound;
  Lanes r = x - power * 6.93145751953125e-1;  // ln 2 in two parts
  r = r - power * 1.42860682030941723212e-6;
  const Lanes z = r * r;
  Lanes p = 1.26177193074810590878e-4 * z + 3.02994407707441961300e-2;
  p = r * (p * z + 9.99999999999999999910e-1);
  Lanes q = 3.00198505138664455042e-6 * z + 2.52448340349684104192e-3;
  q = q * z + 2.27265548208155028766e-1;
  q = q * z + 2;
  const Integers scale = ((Integers)shifted + 1023) << 52;  // 2^power
  return (1 + 2 * p / (q - p)) * (Lanes)scale;
}

// tanh(x), error 3e-16 relative (Cephes, tanh.c).
ARMCAL_INLINE Lanes HyperbolicTangent(const Lanes& x) {
  const Lanes size = x < 0 ? -x : x;
  const Lanes capped = size < 20 ? size : Broadcast(20);  // 1 from there on
  const Lanes large = 1 - 2 / (Exponential(2 * capped) + 1);
  const Lanes z = x * x;
  Lanes p = -9.64399179425052238628e-1 * z - 9.92877231001918586564e1;
  p = p * z - 1.61468768441708447952e3;
  Lanes q = z + 1.12811678491632931402e2;
  q = q * z + 2.23548839060100448583e3;
  q = q * z + 4.84406305325125486048e3;
  const Lanes small = x + x * z * (p / q);
  return size < .625 ? small : (x < 0 ? -large : large);
}

}  // namespace armcal::simd::ARMCAL_INSTRUCTION_SET

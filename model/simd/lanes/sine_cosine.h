#pragma once

#include "model/simd/lanes/lanes.h"

namespace armcal::simd::ARMCAL_INSTRUCTION_SET {

// Angles beyond this take the library's functions, lane by lane.
constexpr double kLargestAngle = 1e5;  // rad

// sin and cos of |x| <= pi / 4: Moshier's polynomials (Cephes, sin.c), relative
// error 2.2e-16.
template <class T>
ARMCAL_INLINE void ReducedSineCosine(const T& x, T* sine, T* cosine) {
  const T z = x * x;
  T s = 1.58962301576546568060e-10 * z - 2.50507477628578072866e-8;
  s = s * z + 2.75573136213857245213e-6;
  s = s * z - 1.98412698295895385996e-4;
  s = s * z + 8.33333333332211858878e-3;
  s = s * z - 1.66666666666666307295e-1;
  T c = -1.13585365213876817300e-11 * z + 2.08757008419747316778e-9;
  c = c * z - 2.75573141792967388112e-7;
  c = c * z + 2.48015872888517045348e-5;
  c = c * z - 1.38888888888730564116e-3;
  c = c * z + 4.16666666666665929218e-2;
  *sine = x + x * z * s;
  *cosine = 1 - .5 * z + z * z * c;
}

// sin and cos of x, rad, to 2.2e-16. What a lane holds does not depend on the
// others.
ARMCAL_INLINE void SineCosine(const Lanes& x, Lanes* sine, Lanes* cosine) {
  // Rounds to an integer, which the lowest bits then hold.
  constexpr double kRound = 6755399441055744.0;  // 1.5 * 2^52
  const Lanes shifted = x * .63661977236758134308 + kRound;
  const Integers quadrant = (Integers)shifted;
  const Lanes turns = shifted - kRound;
  // pi / 2 in three parts, the first two of which times `turns` are exact.
  Lanes r = x - turns * 1.57079625129699707031;
  r = r - turns * 7.54978941586159635335e-8;
  r = r - turns * 5.39030285815811905290e-15;
  Lanes s, c;
  ReducedSineCosine(r, &s, &c);
  const Integers swap = (quadrant & 1) != 0;
  const Lanes odd_sine = swap ? c : s;
  const Lanes odd_cosine = swap ? s : c;
  *sine = (quadrant & 2) != 0 ? -odd_sine : odd_sine;
  *cosine = ((quadrant + 1) & 2) != 0 ? -odd_cosine : odd_cosine;
  const Integers small = (x >= -kLargestAngle) & (x <= kLargestAngle);
  if (__builtin_expect(All(small), true)) return;
  for (int k = 0; k < kLanes; ++k) {
    if (small[k] != 0) continue;
    (*sine)[k] = __builtin_sin(x[k]);
    (*cosine)[k] = __builtin_cos(x[k]);
  }
}

inline void SineCosineOfAll(const double* angle, long count, double* sine,
                            double* cosine) {
  Lanes s, c;
  long k = 0;
  for (; k + kLanes <= count; k += kLanes) {
    SineCosine(Load(angle + k), &s, &c);
    Store(s, sine + k);
    Store(c, cosine + k);
  }
  if (k == count) return;
  Lanes rest = {};
  for (long j = k; j < count; ++j) rest[j - k] = angle[j];
  SineCosine(rest, &s, &c);
  for (long j = k; j < count; ++j) {
    sine[j] = s[j - k];
    cosine[j] = c[j - k];
  }
}

}  // namespace armcal::simd::ARMCAL_INSTRUCTION_SET

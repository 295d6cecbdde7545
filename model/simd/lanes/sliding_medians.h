#pragma once

#include "model/simd/lanes/lanes.h"

namespace armcal::simd::ARMCAL_INSTRUCTION_SET {

// Up to 32 numbers in ascending order, infinities behind them, in registers:
// going through all of them is faster than finding the place of one.
struct SortedNumbers {
  static constexpr int kRegisters = 32 / kLanes;
  Lanes x[kRegisters];

  // Each lane's neighbour; `beyond`: of the last one, or of the first.
  static ARMCAL_INLINE Lanes Next(const Lanes& x, const Lanes& beyond) {
#if ARMCAL_LANES == 8
    return __builtin_shufflevector(x, beyond, 1, 2, 3, 4, 5, 6, 7, 8);
#elif ARMCAL_LANES == 4
    return __builtin_shufflevector(x, beyond, 1, 2, 3, 4);
#else
    return __builtin_shufflevector(x, beyond, 1, 2);
#endif
  }
  static ARMCAL_INLINE Lanes Previous(const Lanes& x, const Lanes& beyond) {
#if ARMCAL_LANES == 8
    return __builtin_shufflevector(beyond, x, 7, 8, 9, 10, 11, 12, 13, 14);
#elif ARMCAL_LANES == 4
    return __builtin_shufflevector(beyond, x, 3, 4, 5, 6);
#else
    return __builtin_shufflevector(beyond, x, 1, 2);
#endif
  }

  ARMCAL_INLINE void Replace(double gone, double number) {
    const Lanes infinity = Broadcast(__builtin_inf());
    const Lanes out = Broadcast(gone), in = Broadcast(number);
    Lanes rest[kRegisters];
#pragma GCC unroll 16
    for (int k = 0; k < kRegisters; ++k) {
      const Lanes& beyond = k + 1 < kRegisters ? x[k + 1] : infinity;
      rest[k] = x[k] < out ? x[k] : Next(x[k], beyond);
    }
    // The middle one of the new number and the two that it may come between.
#pragma GCC unroll 16
    for (int k = 0; k < kRegisters; ++k) {
      const Lanes before = Previous(rest[k], k > 0 ? rest[k - 1] : -infinity);
      const Lanes least = rest[k] < in ? rest[k] : in;
      x[k] = before > least ? before : least;
    }
  }
};

// See Kernels::sliding_medians.
inline void SlidingMedians(const double* x, long count, int reach,
                           double* medians) {
  SortedNumbers window;
  for (Lanes& numbers : window.x) numbers = Broadcast(__builtin_inf());
  const int size = 2 * reach + 1;
  for (long k = 0; k < count; ++k) {
    window.Replace(k < size ? __builtin_inf() : x[k - size], x[k]);
    if (k + 1 < size) continue;
    double numbers[kLanes];
    Store(window.x[reach / kLanes], numbers);
    medians[k - reach] = numbers[reach % kLanes];
  }
}

}  // namespace armcal::simd::ARMCAL_INSTRUCTION_SET

#pragma once

#include "model/simd/lanes/lanes.h"

namespace armcal::simd::ARMCAL_INSTRUCTION_SET {

// The sums of kLanes registers' lanes, one in each lane: neighbours first, then
// pairs of them, then fours.
ARMCAL_INLINE Lanes SumsOfRegisters(const Lanes* x) {
#if ARMCAL_LANES == 8
  Lanes two[4], four[2];
  for (int k = 0; k < 4; ++k) {
    const Lanes &a = x[2 * k], &b = x[2 * k + 1];
    two[k] = __builtin_shufflevector(a, b, 0, 8, 2, 10, 4, 12, 6, 14) +
             __builtin_shufflevector(a, b, 1, 9, 3, 11, 5, 13, 7, 15);
  }
  for (int k = 0; k < 2; ++k) {
    const Lanes &a = two[2 * k], &b = two[2 * k + 1];
    four[k] = __builtin_shufflevector(a, b, 0, 1, 8, 9, 4, 5, 12, 13) +
              __builtin_shufflevector(a, b, 2, 3, 10, 11, 6, 7, 14, 15);
  }
  return __builtin_shufflevector(four[0], four[1], 0, 1, 2, 3, 8, 9, 10, 11) +
         __builtin_shufflevector(four[0], four[1], 4, 5, 6, 7, 12, 13, 14, 15);
#elif ARMCAL_LANES == 4
  Lanes two[2];
  for (int k = 0; k < 2; ++k) {
    const Lanes &a = x[2 * k], &b = x[2 * k + 1];
    two[k] = __builtin_shufflevector(a, b, 0, 4, 2, 6) +
             __builtin_shufflevector(a, b, 1, 5, 3, 7);
  }
  return __builtin_shufflevector(two[0], two[1], 0, 1, 4, 5) +
         __builtin_shufflevector(two[0], two[1], 2, 3, 6, 7);
#else
  return __builtin_shufflevector(x[0], x[1], 0, 2) +
         __builtin_shufflevector(x[0], x[1], 1, 3);
#endif
}

// Numbers that kCount sums take, whole registers.
template <int kCount>
constexpr int kRoomOfSums = (kCount + kLanes - 1) / kLanes* kLanes;

// Each register's sum to `to`, which has kRoomOfSums.
template <int kCount>
ARMCAL_INLINE void StoreSums(const Lanes (&x)[kCount], double* to) {
#pragma GCC unroll 16
  for (int begin = 0; begin < kCount; begin += kLanes) {
    Lanes group[kLanes];
#pragma GCC unroll 8
    for (int k = 0; k < kLanes; ++k) {
      group[k] = begin + k < kCount ? x[begin + k] : Lanes{};
    }
    Store(SumsOfRegisters(group), to + begin);
  }
}

}  // namespace armcal::simd::ARMCAL_INSTRUCTION_SET

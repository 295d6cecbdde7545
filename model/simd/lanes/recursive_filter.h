#pragma once

#include "model/simd/lanes/filter_section.h"
#include "model/simd/lanes/lanes.h"

namespace armcal::simd::ARMCAL_INSTRUCTION_SET {

// What a section remembers of one signal per lane.
struct SectionState {
  Lanes x1, x2, y1, y2;

  ARMCAL_INLINE Lanes Next(const Lanes& b, const Lanes& a1, const Lanes& a2,
                           const Lanes& x) {
    // Nothing but the last product waits for the sample before.
    const Lanes y = b * (x + 2 * x1 + x2) - a2 * y2 - a1 * y1;
    x2 = x1, x1 = x, y2 = y1, y1 = y;
    return y;
  }
};

// Two sections, one behind the other, over kRegisters registers of signals.
template <int kRegisters>
ARMCAL_INLINE void FilterRegisters(const FilterSection* sections, double* row,
                                   long rows, long step) {
  SectionState first[kRegisters], second[kRegisters];
  Lanes rest[kRegisters];
#pragma GCC unroll 2
  for (int r = 0; r < kRegisters; ++r) {
    const Lanes none = {};
    first[r] = second[r] = {none, none, none, none};
    rest[r] = Load(row + r * kLanes);
  }
  const FilterSection &s = sections[0], &t = sections[1];
  const Lanes sb = Broadcast(s.b), sa1 = Broadcast(s.a1), sa2 = Broadcast(s.a2),
              tb = Broadcast(t.b), ta1 = Broadcast(t.a1), ta2 = Broadcast(t.a2);
  for (long k = 0; k < rows; ++k, row += step) {
#pragma GCC unroll 2
    for (int r = 0; r < kRegisters; ++r) {
      const Lanes x = Load(row + r * kLanes) - rest[r];
      const Lanes y = first[r].Next(sb, sa1, sa2, x);
      Store(second[r].Next(tb, ta1, ta2, y) + rest[r], row + r * kLanes);
    }
  }
}

// See Kernels::filter_both_ways.
inline void FilterBothWays(const FilterSection* sections, double* x, long rows,
                           int width) {
  const auto filter = [&](double* row, long step) {
    int c = 0;
    for (; c + 2 * kLanes <= width; c += 2 * kLanes) {
      FilterRegisters<2>(sections, row + c, rows, step);
    }
    if (c < width) FilterRegisters<1>(sections, row + c, rows, step);
  };
  filter(x, width);
  filter(x + (rows - 1) * width, -width);
}

}  // namespace armcal::simd::ARMCAL_INSTRUCTION_SET

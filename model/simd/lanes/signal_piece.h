#pragma once

#include "model/simd/lanes/lanes.h"

namespace armcal::simd::ARMCAL_INSTRUCTION_SET {

// Weights of InterpolateColumns (model/dynamics/motion_track.h) at a stage.
struct StageWeights {
  Lanes at, next, slope_at, slope_next;
};

ARMCAL_INLINE StageWeights WeightsAt(const Lanes& share) {
  const Lanes s = share, r = 1 - share;
  return {r * r * (1 + 2 * s), s * s * (1 + 2 * r), s * r * r, -s * s * r};
}

// A signal from one sample to the next, and its slopes at both.
struct SignalPiece {
  Lanes at, next, slope_at, slope_next;
  ARMCAL_INLINE Lanes operator()(const StageWeights& w) const {
    return w.at * at + w.next * next + w.slope_at * slope_at +
           w.slope_next * slope_next;
  }
};

ARMCAL_INLINE Lanes Gather(const double* const* from, long sample) {
  Lanes x;
  for (int k = 0; k < kLanes; ++k) x[k] = from[k][sample];
  return x;
}

// A signal's pieces one after the other: of four samples that one takes three
// are there from the last.
struct SignalPieces {
  const double* const* signal;
  long last;  // sample
  Lanes before, at, next, after;

  ARMCAL_INLINE SignalPieces(const double* const* of, long samples)
      : signal(of), last(samples - 1) {
    next = Gather(signal, 0);
    after = Gather(signal, last > 0 ? 1 : 0);
  }
  // Of sample k to the next, for k = 0, 1, .. last - 1.
  ARMCAL_INLINE SignalPiece MoveTo(long k) {
    const bool first = k == 0, ends = k + 1 == last;
    before = first ? next : at;
    at = next;
    next = after;
    if (!ends) after = Gather(signal, k + 2);
    return {at, next, (next - before) * (first ? 1 : .5),
            (after - at) * (ends ? 1 : .5)};
  }
};

}  // namespace armcal::simd::ARMCAL_INSTRUCTION_SET

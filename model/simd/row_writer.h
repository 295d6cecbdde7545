#pragma once

#include "model/simd/chain_constants.h"
#include "model/simd/lanes.h"

namespace armcal::simd::ARMCAL_INSTRUCTION_SET {

// A set of moments that the compiler knows.
template <unsigned kMoments>
struct MomentSet {
  static constexpr unsigned kValue = kMoments;
};
template <class Function>
ARMCAL_INLINE void ForMoments(unsigned moments, const Function& function) {
  if (moments == kMomentsOfLink) {
    function(MomentSet<kMomentsOfLink>());
  } else if (moments == kMomentsOfJoint) {
    function(MomentSet<kMomentsOfJoint>());
  }
}

// One row's columns of one link, in as many outputs; kAll: every moment is
// wanted.
template <int kOutputs, bool kAll>
struct RowWriter {
  double* rows[kOutputs];
  long stride;
  const int* place;

  template <class T, class... More>
  ARMCAL_INLINE void Write(const T& value, const More&... more) {
    static_assert(1 + sizeof...(More) == kOutputs, "a value for each output");
    const int to = *place++;
    if (!kAll && to < 0) return;
    int output = 0;
    StoreAs(value, rows[output++] + to * stride);
    (StoreAs(more, rows[output++] + to * stride), ...);
  }
};

ARMCAL_INLINE const int* PlacesOfRow(const LinkConstants& link, int k) {
  return link.places + k * (link.num_moments + link.num_length_columns);
}

}  // namespace armcal::simd::ARMCAL_INSTRUCTION_SET

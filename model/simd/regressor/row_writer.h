#pragma once

#include "model/simd/lanes/lanes.h"
#include "model/simd/regressor/chain_constants.h"

namespace armcal::simd::ARMCAL_INSTRUCTION_SET {

// A set of moments that the compiler knows; kAll: every one is wanted.
template <unsigned kMoments, bool kAllWanted>
struct MomentSet {
  static constexpr unsigned kValue = kMoments;
  static constexpr bool kAll = kAllWanted;
};
template <class Function>
ARMCAL_INLINE void ForMoments(const LinkConstants& link,
                              const Function& function) {
  if (link.moments == kMomentsOfLink && link.all_moments) {
    function(MomentSet<kMomentsOfLink, true>());
  } else if (link.moments == kMomentsOfLink) {
    function(MomentSet<kMomentsOfLink, false>());
  } else if (link.moments == kMomentsOfJoint) {
    function(MomentSet<kMomentsOfJoint, false>());
  }
}

// One row's columns of one link, in as many outputs.
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

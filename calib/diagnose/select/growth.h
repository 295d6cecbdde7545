#pragma once

#include <vector>

#include "calib/diagnose/candidates/candidates.h"
#include "calib/diagnose/select/regression.h"
#include "calib/diagnose/select/selection_options.h"

namespace armcal {

struct Growth {
  std::vector<int> effects;
  // Whether zeros of torques were likelier to have moved on several joints than
  // any effect was to be there, where the search stopped; where they are held.
  bool other_zeros = false;
  // The likeliest one where the search stopped, if it is of all joints and less
  // likely than what looks so where each joint has it; -1: none.
  int looks_like_it = -1;
};

// Effects one by one, of those that explain most of the gap the one whose
// larger model is the most likely given those before (CompareLarger's odds less
// the penalty of its parameters), as long as that is above the threshold. The
// regression's noise is then that of what the last of these models leaves: an
// effect that explains most of the torque shows how small the noise is only
// once it is in the model.
Growth GrowEffects(const std::vector<GapCandidate>& candidates,
                   const SelectionOptions& options, GapRegression* regression);

}  // namespace armcal

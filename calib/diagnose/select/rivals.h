#pragma once

#include <optional>
#include <vector>

#include "calib/diagnose/candidates/refinement.h"
#include "calib/diagnose/select/pool.h"
#include "calib/diagnose/select/regression.h"
#include "calib/diagnose/select/selection.h"

namespace armcal {

// The score of an effect whose shape is fitted, not one of a grid.
struct RefinedScore {
  const Effect* effect = nullptr;
  int joint = -1;
  double score = 0;
  // Whether its estimates can be of a real arm (Effect::plausible).
  bool is_possible = true;
};

struct Rivals {
  std::vector<RefinedScore> scores;  // the chosen one's, if near, among them
  int best = -1;                     // candidate
  // With the best in the k-th place, all others as they were; none where
  // nothing was near.
  std::optional<RefinedEffects> refined;
};

// A grid may be kinder to one effect than to another: those near the k-th
// chosen one in score take its place in turn, each with its shape fitted given
// the others, which stay.
Rivals CompareRivals(const GapRegression& regression, const CandidatePool& pool,
                     const SelectionOptions& options,
                     const Selection& selection, int k);

}  // namespace armcal

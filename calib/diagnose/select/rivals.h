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

// What a rival explains beyond the other effects, its shape fitted, and its
// penalty.
struct FittedRival {
  int joint = -1;
  double delta_chi2 = 0, penalty = 0;
};

// Takes from each rival what it explains beyond a simpler one of its joint
// (whose penalty is lower) where that is less than this share of what it
// explains: an error of form.
void LeaveOutErrorsOfForm(double share, std::vector<FittedRival>* rivals);

// A grid may be kinder to one effect than to another: those near the k-th
// chosen one in score take its place in turn, each with its shape fitted given
// the others, which stay.
Rivals CompareRivals(const GapRegression& regression, const CandidatePool& pool,
                     const SelectionOptions& options,
                     const Selection& selection, int k);

}  // namespace armcal

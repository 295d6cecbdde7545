#pragma once

#include "calib/diagnose/candidates/refinement.h"
#include "calib/diagnose/select/pool.h"
#include "calib/diagnose/select/regression.h"
#include "calib/diagnose/select/selection.h"

namespace armcal {

// The effect (its place in the selection) without which the others, fitted as
// they are and not as columns have them, explain as much: it stood for what is
// not linear in them. -1: there is none, or no other.
int FindRedundant(const GapRegression& regression, const CandidatePool& pool,
                  const SelectionOptions& options, const Selection& selection,
                  const RefinedEffects& refined);

// The effect (its place in the selection) that was chosen for a column which
// its law does not keep: all effects as fitted explain less than the others'
// columns without it, and its penalty. -1: there is none.
int FindHollow(const GapScreen& screen,
               const std::vector<GapCandidate>& candidates,
               const Selection& selection, const RefinedEffects& refined);

}  // namespace armcal

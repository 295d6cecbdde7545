#pragma once

#include <functional>
#include <vector>

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
// columns without it, and its penalty. -1: there is none. `fitted_without`: the
// delta_chi2 of all but the k-th, fitted as they are; asked of several such.
int FindHollow(const GapScreen& screen,
               const std::vector<GapCandidate>& candidates,
               const Selection& selection, const RefinedEffects& refined,
               const std::function<double(size_t)>& fitted_without);

}  // namespace armcal

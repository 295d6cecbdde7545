#pragma once

#include <cstddef>
#include <vector>

#include "calib/inspect/held_out_fit.h"
#include "calib/inspect/reading_candidates.h"
#include "calib/inspect/reading_state.h"

namespace armcal {

// Whether joints that are beyond the file's limits as it is are within them
// otherwise, as another's positions or as turned round.
bool BringsInReach(const ReadingState& state, const Candidate& candidate);

// Whether torques that a fit has not seen say that the candidate, whose fit is
// `held_out`, reads the log better than the state's best, whose is `as_is`.
bool IsConfirmed(const ReadingState& state, const Candidate& candidate,
                 const HeldOutFit& as_is, const HeldOutFit& held_out);

// Of candidates with these misfits, changes that would do as well as the k-th,
// or nearly so: then what the model misses may decide between them.
std::vector<ReadingChange> AlternativesTo(size_t k, const HeldOutFit& held_out,
                                          const std::vector<double>& misfits,
                                          const std::vector<Candidate>& all,
                                          const ReadingState& state);

}  // namespace armcal

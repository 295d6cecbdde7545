#pragma once

#include <cstdint>
#include <vector>

#include "calib/diagnose/candidates/candidates.h"
#include "calib/diagnose/data/rows.h"
#include "calib/diagnose/data/screen.h"
#include "calib/diagnose/select/selection.h"

namespace armcal {

// The score that the best candidate of all has by chance in one of a hundred
// such logs or, if it is lower, that of a joint (-1: of the whole robot) where
// in one of a hundred any joint's stands out as far from its own usual scores:
// of the same robot and motion, with what the chosen effects leave of the
// residual as noise. Blocks of it get random signs
// (wild bootstrap, Wu 1986), so that its size, its correlation in time and
// among joints stay.
double ScoreByChance(const GapScreen& screen, const GapRows& rows,
                     const std::vector<GapCandidate>& candidates,
                     const SelectionOptions& options,
                     const std::vector<int>& chosen, int joint,
                     std::uint64_t seed);

// What is left of a selection without those, weakest first, that may have come
// by chance: whose score does not exceed ScoreByChance given the others, or
// the threshold once their delta chi^2 is divided by Inflation.
Selection WithoutChance(const GapScreen& screen, const GapRows& rows,
                        const std::vector<GapCandidate>& candidates,
                        const SelectionOptions& options, Selection selection,
                        std::uint64_t seed);

}  // namespace armcal

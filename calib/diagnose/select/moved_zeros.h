#pragma once

#include <vector>

#include "calib/diagnose/candidates/candidates.h"
#include "calib/diagnose/data/screen.h"
#include "calib/diagnose/select/next_effect.h"
#include "calib/diagnose/select/regression.h"
#include "calib/diagnose/select/selection_options.h"

namespace armcal {

// Whether zeros of torques have moved on several joints. Where they may have,
// they are held against all effects that would else be taken one by one: of
// what a payload and another effect make together they explain more than the
// payload does. Both may have as many effects in all, each zero being one, and
// zeros that are told as moved, which no probability goes with, have to be
// likelier by what an effect has to be likelier than none by. Offsets of
// several joints that are taken one by one are the same zeros.
bool HaveZerosMoved(const std::vector<GapCandidate>& candidates,
                    const SelectionOptions& options,
                    const std::vector<int>& set, const GapScreen& smaller,
                    const NextEffect& next, GapRegression* regression);

}  // namespace armcal

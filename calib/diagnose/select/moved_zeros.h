#pragma once

#include <vector>

#include "calib/diagnose/candidates/candidates.h"
#include "calib/diagnose/data/screen.h"
#include "calib/diagnose/select/next_effect.h"
#include "calib/diagnose/select/regression.h"
#include "calib/diagnose/select/selection_options.h"

namespace armcal {

// Whether zeros of torques have moved on several joints. Where they may have,
// these and the likeliest effects beside them are held against as many effects
// that are taken one by one, each the likeliest: of what a payload and another
// effect make together zeros explain more than the payload does. No probability
// goes with zeros that have moved, so that they have to be likelier by as much
// as one effect more has to be (SelectionOptions::threshold). Where offsets of
// several joints are among the effects that are taken one by one, both say the
// same.
bool HaveZerosMoved(const std::vector<GapCandidate>& candidates,
                    const SelectionOptions& options,
                    const std::vector<int>& set, const GapScreen& smaller,
                    const NextEffect& next, GapRegression* regression);

}  // namespace armcal

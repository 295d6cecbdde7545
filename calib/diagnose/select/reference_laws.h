#pragma once

#include <vector>

#include "calib/diagnose/data/baseline.h"
#include "calib/diagnose/data/data.h"
#include "calib/diagnose/data/known_effects.h"
#include "calib/diagnose/data/segment.h"

namespace armcal {

// Laws of the catalogue that a reference shows by itself, given `baseline`,
// and shows again in those of its parts (reference_folds.h) that they were not
// fitted to: a short log alone would show many. `data` are of the segments;
// they then have the noise that these laws leave.
KnownEffects FindReferenceLaws(const GapBaseline& baseline,
                               const std::vector<GapSegment>& segments,
                               GapData* data);

}  // namespace armcal

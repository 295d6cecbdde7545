#pragma once

#include <vector>

#include "calib/diagnose/data/baseline.h"
#include "calib/diagnose/data/noise.h"
#include "calib/diagnose/data/segment.h"

namespace armcal {

// Noise of torques given the model: as what a fit leaves, and as much larger
// as it is in parts that a fit to the others has not seen (reference_folds.h):
// other logs are motion that no fit has seen, and a model is not quite right.
GapNoise ReferenceNoise(const GapBaseline& baseline, double bandwidth_hz,
                        const std::vector<GapSegment>& segments);

}  // namespace armcal

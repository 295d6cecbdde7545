#pragma once

#include <vector>

#include "calib/poses/fit.h"

namespace armcal {

// Touches tell an arm's lengths but for one factor on all of them, with tools,
// points and planes: the fit holds the longest. Gives all of them the factor
// with which those that touches tell, and the held one, are nearest to the
// file's, by least squares, as lengths that are off by alike errors ask for.
// What touches leave stays as it is; where it does not (a joint that slides
// tells the scale), nothing is changed.
void SetScaleByFile(const PoseFit& fit, const PoseMeasurements& measured,
                    const std::vector<bool>& free, PoseUnknowns* unknowns);

}  // namespace armcal

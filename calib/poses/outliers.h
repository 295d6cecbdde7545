#pragma once

#include <vector>

#include "calib/poses/fit.h"

namespace armcal {

// Of poses `rows` those one of whose residual vectors (of a target, the pose or
// the wire) is so long that Tukey's loss gives it up.
std::vector<int> FindOutliers(const PoseFit& fit, const PoseUnknowns& at,
                              const std::vector<int>& rows);

}  // namespace armcal

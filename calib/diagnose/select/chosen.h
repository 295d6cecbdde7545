#pragma once

#include <vector>

#include "calib/diagnose/candidates/candidates.h"

namespace armcal {

// All but chosen[k]; all where k is -1.
std::vector<int> Without(std::vector<int> chosen, int k);

// Columns of several candidates.
std::vector<int> ColumnsOf(const std::vector<GapCandidate>& candidates,
                           const std::vector<int>& chosen);

}  // namespace armcal

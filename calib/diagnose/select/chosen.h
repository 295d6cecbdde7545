#pragma once

#include <vector>

#include "calib/diagnose/candidates/candidates.h"

namespace armcal {

// All but chosen[k]; all where k is -1.
std::vector<int> Without(std::vector<int> chosen, int k);

// Columns of several candidates.
std::vector<int> ColumnsOf(const std::vector<GapCandidate>& candidates,
                           const std::vector<int>& chosen);
// These with their linear parameters, solved together on the screen whose
// columns they have.
std::vector<GapCandidate> FittedTo(const GapScreen& screen,
                                   const std::vector<GapCandidate>& candidates,
                                   const std::vector<int>& which);
// Whether a real arm can have these estimates (Effect::plausible): what fits
// about as well as something that can be is not what cannot.
bool IsPossible(const GapCandidate& fitted, const Robot& robot,
                const MotionScale& scale);

}  // namespace armcal

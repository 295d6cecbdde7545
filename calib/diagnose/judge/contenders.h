#pragma once

#include <vector>

#include "calib/diagnose/select/fit.h"

namespace armcal {

// Candidates of the fit (indices) that could be chosen from the same data with
// somewhat less of them: the best shape of each effect at each place that
// scores at all, alone, in the place of one that was chosen, or beside all.
std::vector<int> Contenders(const GapFit& fit);

}  // namespace armcal

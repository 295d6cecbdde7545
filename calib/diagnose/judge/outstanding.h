#pragma once

#include <vector>

namespace armcal {

// How probable it is that the largest of as many peaks of what a model lacks is
// as large as this one, its smaller fellows being such peaks; of each of these
// sizes (any unit, above 0). 1 for those that fewer than four are smaller than.
std::vector<double> ChancesAmongPeaks(const std::vector<double>& sizes);

}  // namespace armcal

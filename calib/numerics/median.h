#pragma once

#include <vector>

namespace armcal {

// The upper median: of an even number of values the larger of the middle two;
// 0 of none.
double Median(std::vector<double> values);
// Root of the mean square; NaN of none.
double Rms(const std::vector<double>& values);

}  // namespace armcal

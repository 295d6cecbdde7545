#pragma once

#include <vector>

namespace armcal {

// The upper median: of an even number of values the larger of the middle two;
// 0 of none.
double Median(std::vector<double> values);
// The quantile of a share (0 to 1) of values, linear between neighbours (type 7
// of Hyndman and Fan 1996); NaN of none.
double Quantile(std::vector<double> values, double share);
// Root of the mean square; NaN of none.
double Rms(const std::vector<double>& values);

}  // namespace armcal

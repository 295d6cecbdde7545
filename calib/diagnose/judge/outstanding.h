#pragma once

#include <Eigen/Core>
#include <vector>

namespace armcal {

// How probable it is that the largest of as many peaks of what a model lacks is
// as large as this one, its smaller fellows being such peaks, whose sizes have
// an exponential tail, and any number of its larger ones; of each of these
// sizes (any unit, above 0). 1 for those that fewer than four are smaller than.
std::vector<double> ChancesAmongPeaks(const std::vector<double>& sizes);

// The most probable it is that one of these normal deviations, of given
// standard deviations, is as many of these as the largest of `values` is, in so
// many draws of all of them (Bonferroni's bound, at most 1):
//   p = draws n erfc(z / sqrt(2)),  z = max |value| / stddev.
// Deviations of 0 tell nothing.
double ChanceOfLargest(const Eigen::VectorXd& values,
                       const Eigen::VectorXd& stddev, double draws);

}  // namespace armcal

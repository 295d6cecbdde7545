#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace armcal {

// Combinations of the parameters `free` (with names) of which data (A, whose
// A'A is their information; columns are all parameters) tell less than a prior
// of these variances, as texts; a variance of 1e100 and more: no prior.
std::vector<std::string> UnseenCombinations(
    const std::vector<int>& free, const std::vector<std::string>& names,
    const Eigen::MatrixXd& data, const Eigen::VectorXd& prior);

}  // namespace armcal

#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace armcal {

// A combination of parameters: the largest coefficient is 1.
struct Combination {
  Eigen::VectorXd x;
  std::string text;  // "viscous[4]", "1.00 Izz[3] - 0.52 hx[4]"
};

// Combinations that span what the columns of N do, N in coordinates
// y = scale * x, each with one parameter for its own (reduced echelon form with
// full pivoting, in the order of these parameters): what cannot be seen of a
// joint at rest then reads as three parameters, not as three mixtures of them.
std::vector<Combination> NameCombinations(
    const Eigen::MatrixXd& N, const Eigen::VectorXd& scale,
    const std::vector<std::string>& names);

}  // namespace armcal

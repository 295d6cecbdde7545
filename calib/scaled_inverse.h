#pragma once

#include <Eigen/Core>
#include <vector>

namespace armcal {

// The inverse of a positive definite matrix whose units differ by many orders,
// of the rows and columns `kept`; the others are 0.
Eigen::MatrixXd ScaledInverse(const Eigen::MatrixXd& A,
                              const std::vector<int>& kept);

}  // namespace armcal

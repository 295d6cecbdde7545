#pragma once

#include <Eigen/Core>

namespace armcal {

struct SingularValues {
  Eigen::MatrixXd U;  // thin
  Eigen::VectorXd s;  // the largest first
  Eigen::MatrixXd V;  // all of it
};

// A = U diag(s) V'. Where Eigen's divide and conquer ends in NaN, as it does
// now and then of columns whose sizes differ by all of a double's digits, by
// Jacobi's rotations.
SingularValues DecomposeSingular(const Eigen::MatrixXd& A);

}  // namespace armcal

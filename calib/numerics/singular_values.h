#pragma once

#include <Eigen/Core>

namespace armcal {

struct SingularValues {
  Eigen::MatrixXd U;  // thin
  Eigen::VectorXd s;  // the largest first
  Eigen::MatrixXd V;  // all of it
};

// A = U diag(s) V', to 1e-12 of A, by Jacobi's rotations. Eigen's divide and
// conquer (3.4) is quicker beyond a hundred columns, but of columns whose sizes
// differ by all of a double's digits it makes NaN, vectors of length 0 or
// another matrix, and reads outside its arrays.
SingularValues DecomposeSingular(const Eigen::MatrixXd& A);

}  // namespace armcal

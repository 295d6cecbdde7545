#pragma once

#include <Eigen/Core>

namespace armcal {

struct SingularValues {
  Eigen::MatrixXd U;  // thin
  Eigen::VectorXd s;  // the largest first
  Eigen::MatrixXd V;  // all of it
};

// A = U diag(s) V', to 1e-12 of A. Of columns whose sizes differ by all of a
// double's digits Eigen's divide and conquer now and then makes NaN, vectors of
// length 0 or another matrix; then it is done by Jacobi's rotations.
SingularValues DecomposeSingular(const Eigen::MatrixXd& A);

}  // namespace armcal

#pragma once

#include <Eigen/Eigenvalues>
#include <Eigen/SVD>

// Eigen's decompositions of dynamic size, compiled once in dense_solvers.cc:
// each takes many seconds wherever it is instantiated.
extern template class Eigen::BDCSVD<Eigen::MatrixXd>;
extern template class Eigen::JacobiSVD<Eigen::MatrixXd>;
extern template class Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>;

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

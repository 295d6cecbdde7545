#pragma once

#include <Eigen/Eigenvalues>
#include <Eigen/SVD>

// Eigen's decompositions of dynamic size, compiled once in dense_solvers.cc:
// each takes many seconds wherever it is instantiated.
extern template class Eigen::JacobiSVD<Eigen::MatrixXd>;
extern template class Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>;

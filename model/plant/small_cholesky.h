#pragma once

#include <Eigen/Core>

namespace armcal {

// Eigen's Cholesky factor L L' of a symmetric positive definite matrix of a few
// rows, as mass matrices are, for sizes 1 to 8 with loops of constant length:
// a simulation has one in each stage of each step, where a matrix of 6 rows of
// any size takes several times as long.
class SmallCholesky {
 public:
  void Compute(const Eigen::MatrixXd& a);
  // x of a x = b.
  Eigen::VectorXd Solve(const Eigen::VectorXd& b) const;

 private:
  Eigen::MatrixXd factor_;  // L below and on the diagonal
};

}  // namespace armcal

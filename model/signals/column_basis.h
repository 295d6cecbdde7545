#pragma once

#include <Eigen/Core>
#include <vector>

namespace armcal {

// Columns that span a matrix, taken greedily in their order (so that a name
// keeps its meaning), and how the others follow from them.
class ColumnBasis {
 public:
  explicit ColumnBasis(int rows) : Q_(rows, 0) {}

  // Adds `column` to the span unless it lies in it: within `tolerance` times
  // `scale`, the size of a column that would count. Returns whether it was
  // added.
  bool Add(const Eigen::VectorXd& column, double scale,
           double tolerance = 1e-8);

 private:
  Eigen::MatrixXd Q_;  // orthonormal
};

// Coefficients c with A.col(j) = sum_k c_k A.col(kept[k]) in the least-squares
// sense, those below 1e-10 set to zero.
Eigen::VectorXd ExpressInColumns(const Eigen::MatrixXd& A, int j,
                                 const std::vector<int>& kept);

}  // namespace armcal

#pragma once

#include <Eigen/Core>
#include <vector>

namespace armcal {

// The Cholesky factor of a symmetric positive definite block-tridiagonal
// matrix: what normal equations of splines and of other chains in time are.
// Time and memory are linear in the number of blocks.
class BlockTridiagonalFactor {
 public:
  // The blocks of a matrix: diagonal[k] is (k, k), all of one size; lower[k] is
  // (k + 1, k), one less.
  struct Blocks {
    std::vector<Eigen::MatrixXd> diagonal, lower;

    Blocks(int count, int size);
    int block_size() const { return static_cast<int>(diagonal[0].rows()); }
    // The square of width `size` (at most two blocks) on the diagonal that
    // begins at row `begin`: added to (symmetric), or read.
    void Add(int begin, const Eigen::MatrixXd& square);
    Eigen::MatrixXd Square(int begin, int size) const;
  };

  explicit BlockTridiagonalFactor(const Blocks& matrix);

  // False where a pivot was not positive: nothing else may be asked for.
  bool positive() const { return positive_; }
  Eigen::MatrixXd Solve(const Eigen::MatrixXd& right) const;
  // The inverse where the matrix has blocks (Takahashi's recursion).
  Blocks Inverse() const;

 private:
  Blocks L_;  // diagonal: lower triangles
  bool positive_ = true;
};

}  // namespace armcal

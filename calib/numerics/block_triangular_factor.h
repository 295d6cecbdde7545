#pragma once

#include <Eigen/Core>
#include <vector>

#include "calib/numerics/triangular_factor.h"
#include "model/dynamics/model_parameters.h"

namespace armcal {

// The sufficient statistic of a log: for every joint i the triangular factor of
// its equations [U_ii ... U_in | Y_i], updated by Householder QR as rows come
// in. It needs hardly more memory for longer logs, and from it follow the
// recursive solution (2.28), the batch solution (2.25), every solution weighted
// per joint, all residuals' norms, ranks and covariances; normal equations,
// which square the condition, are never formed.
class BlockTriangularFactor {
 public:
  // leaf_rows: of TriangularFactor.
  explicit BlockTriangularFactor(const ModelParameters& parameters,
                                 long leaf_rows = TriangularFactor::kLeafRows);

  // With each joint's factor known.
  BlockTriangularFactor(const ModelParameters& parameters,
                        std::vector<TriangularFactor> factors);

  // Adds joint i's equation u x = y times `weight`; u holds all parameters.
  void Add(int i, const Eigen::RowVectorXd& u, double y, double weight = 1);
  // Adds joint i's equations of another factor of the same parameters.
  void Merge(const BlockTriangularFactor& other, int i);

  // Of factors whose joints have all been given the same rows, the leaf under
  // way and those after it, as in TriangularFactor; one per joint.
  long leaf_rows() const { return factors_[0].leaf_rows(); }
  void TakeLeaves(std::vector<LeafFactor>* leaves);
  void PutLeaves(std::vector<LeafFactor>* leaves);

  int num_joints() const { return static_cast<int>(factors_.size()); }
  int num_parameters() const { return num_parameters_; }
  int block_begin(int i) const { return block_begin_[i]; }
  int block_size(int i) const { return block_begin_[i + 1] - block_begin_[i]; }
  // The parameters of joint i's equations, ascending; its own block first.
  const std::vector<int>& columns(int i) const { return columns_[i]; }
  long rows(int i) const { return factors_[i].rows(); }
  // Upper triangle of size columns(i).size() + 1, the right side last.
  const Eigen::MatrixXd& Triangle(int i) const {
    return factors_[i].Triangle();
  }

  // Root of the sum of squared residuals of joint i's equations at x.
  double ResidualNorm(int i, const Eigen::VectorXd& x) const;

 private:
  int num_parameters_;
  std::vector<int> block_begin_;
  std::vector<std::vector<int>> columns_;
  std::vector<TriangularFactor> factors_;
};

// Root mean square of each joint's right-hand side.
Eigen::VectorXd RightSideRms(const BlockTriangularFactor& factor);

}  // namespace armcal

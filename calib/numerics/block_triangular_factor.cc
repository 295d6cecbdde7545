#include "calib/numerics/block_triangular_factor.h"

#include <glog/logging.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace armcal {

using Eigen::MatrixXd;
using Eigen::VectorXd;

BlockTriangularFactor::BlockTriangularFactor(const ModelParameters& parameters,
                                             long leaf_rows)
    : num_parameters_(parameters.size()) {
  for (int i = 0; i <= parameters.num_joints(); ++i) {
    block_begin_.push_back(parameters.block_begin(i));
  }
  for (int i = 0; i < parameters.num_joints(); ++i) {
    columns_.push_back(parameters.row_columns(i));
    factors_.emplace_back(static_cast<int>(columns_.back().size()), leaf_rows);
  }
}

BlockTriangularFactor::BlockTriangularFactor(
    const ModelParameters& parameters, std::vector<TriangularFactor> factors)
    : BlockTriangularFactor(parameters) {
  CHECK_EQ(factors.size(), factors_.size());
  for (size_t i = 0; i < factors.size(); ++i) {
    CHECK_EQ(factors[i].columns(), factors_[i].columns());
  }
  factors_ = std::move(factors);
}

void BlockTriangularFactor::Add(int i, const Eigen::RowVectorXd& u, double y,
                                double weight) {
  CHECK_EQ(u.size(), num_parameters_);
  factors_[i].Add(u(columns_[i]), y, weight);
}

void BlockTriangularFactor::Merge(const BlockTriangularFactor& other, int i) {
  CHECK_EQ(other.num_parameters_, num_parameters_);
  factors_[i].Merge(other.factors_[i]);
}

void BlockTriangularFactor::TakeLeaves(std::vector<LeafFactor>* leaves) {
  for (size_t i = 0; i < factors_.size(); ++i) {
    factors_[i].TakeLeaf(&(*leaves)[i]);
  }
}

void BlockTriangularFactor::PutLeaves(std::vector<LeafFactor>* leaves) {
  for (size_t i = 0; i < factors_.size(); ++i) {
    factors_[i].PutLeaf(&(*leaves)[i]);
  }
}

double BlockTriangularFactor::ResidualNorm(int i, const VectorXd& x) const {
  const std::vector<int>& used = columns(i);
  VectorXd z(used.size() + 1);
  for (size_t c = 0; c < used.size(); ++c) z[c] = x[used[c]];
  z[used.size()] = -1;
  return (Triangle(i).triangularView<Eigen::Upper>() * z).norm();
}

VectorXd RightSideRms(const BlockTriangularFactor& factor) {
  VectorXd rms(factor.num_joints());
  for (int i = 0; i < factor.num_joints(); ++i) {
    const double rows = static_cast<double>(std::max(1L, factor.rows(i)));
    rms[i] = factor.Triangle(i).rightCols<1>().norm() / std::sqrt(rows);
  }
  return rms;
}

}  // namespace armcal

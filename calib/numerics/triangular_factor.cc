#include "calib/numerics/triangular_factor.h"

#include <glog/logging.h>

#include <algorithm>
#include <utility>

namespace armcal {

using Eigen::MatrixXd;

TriangularFactor::TriangularFactor(int columns, long leaf_rows)
    : leaf_rows_(leaf_rows), leaf_(columns) {}

TriangularFactor::TriangularFactor(const MatrixXd& triangle, long rows)
    : TriangularFactor(static_cast<int>(triangle.cols()) - 1) {
  merged_ = triangle_ = triangle;
  merged_rows_ = rows;
}

long TriangularFactor::rows() const {
  return leaves_ * leaf_rows_ + leaf_.rows() + merged_rows_;
}

void TriangularFactor::AddRows(const double* rows, long stride, long count,
                               const double* weights) {
  for (long begin = 0; begin < count;) {
    const long taken =
        std::min({count - begin, leaf_.room(), leaf_rows_ - leaf_.rows()});
    for (int c = 0; c <= columns(); ++c) {
      const double* from = rows + c * stride + begin;
      double* to = leaf_.Next() + c * LeafFactor::kStride;
      for (long r = 0; r < taken; ++r) {
        to[r] = weights == nullptr ? from[r] : weights[begin + r] * from[r];
      }
    }
    leaf_.Commit(taken);
    CloseLeaf();
    begin += taken;
  }
}

void TriangularFactor::CloseLeaf() {
  triangle_.resize(0, 0);
  if (leaf_.rows() < leaf_rows_) return;
  MatrixXd R = leaf_.Triangle();
  leaf_.Clear();
  ++leaves_;
  size_t k = 0;
  for (; k < tree_.size() && tree_[k].size() > 0; ++k) {
    R = MergeTriangles(tree_[k], R);
    tree_[k].resize(0, 0);
  }
  if (k == tree_.size()) tree_.emplace_back();
  tree_[k] = std::move(R);
}

void TriangularFactor::Merge(const TriangularFactor& other) {
  CHECK_EQ(other.columns(), columns());
  const MatrixXd& R = other.Triangle();
  merged_ = merged_rows_ == 0 ? R : MergeTriangles(merged_, R);
  merged_rows_ += other.rows();
  triangle_.resize(0, 0);
}

const MatrixXd& TriangularFactor::Triangle() const {
  if (triangle_.size() > 0) return triangle_;
  triangle_ = leaf_.Triangle();
  for (const MatrixXd& R : tree_) {
    if (R.size() > 0) triangle_ = MergeTriangles(R, triangle_);
  }
  if (merged_rows_ > 0) triangle_ = MergeTriangles(merged_, triangle_);
  return triangle_;
}

void TriangularFactor::TakeLeaf(LeafFactor* leaf) {
  leaf->Clear();
  std::swap(leaf_, *leaf);
  triangle_.resize(0, 0);
}

void TriangularFactor::PutLeaf(LeafFactor* leaf) {
  CHECK_EQ(leaf_.rows(), 0);
  CHECK_LE(leaf->rows(), leaf_rows_);
  std::swap(leaf_, *leaf);
  leaf->Clear();
  CloseLeaf();
}

}  // namespace armcal

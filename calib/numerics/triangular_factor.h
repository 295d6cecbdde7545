#pragma once

#include <Eigen/Core>
#include <vector>

#include "calib/numerics/leaf_factor.h"

namespace armcal {

// The triangular factor of linear equations [A | y], updated as rows come in.
// Every leaf_rows() rows, counted from the first, are a leaf; leaves are merged
// like the digits of a binary counter. So the factor is the same bits whether
// rows come one by one or many at once and whoever reduced the leaves, in the
// memory of a chunk and a triangle for each doubling of the rows.
class TriangularFactor {
 public:
  static constexpr long kLeafRows = 8 * LeafFactor::kChunkRows;
  explicit TriangularFactor(int columns, long leaf_rows = kLeafRows);
  // Of `rows` equations whose triangle is known.
  TriangularFactor(const Eigen::MatrixXd& triangle, long rows);

  int columns() const { return leaf_.columns(); }
  long rows() const;
  // Adds weight * (row x = y).
  template <class Row>
  void Add(const Row& row, double y, double weight) {
    double* next = leaf_.Next();
    Eigen::Map<Eigen::RowVectorXd, 0, Eigen::InnerStride<>>(
        next, columns(), Eigen::InnerStride<>(LeafFactor::kStride)) =
        weight * row;
    next[columns() * LeafFactor::kStride] = weight * y;
    leaf_.Commit(1);
    CloseLeaf();
  }
  // Adds `count` rows: columns a stride apart, the right side last; each times
  // its weight, where there are weights.
  void AddRows(const double* rows, long stride, long count,
               const double* weights = nullptr);
  // Adds all equations of the other.
  void Merge(const TriangularFactor& other);
  // Upper triangle of columns() + 1, the right side last.
  const Eigen::MatrixXd& Triangle() const;

  // For rows that are reduced elsewhere: the leaf under way, to be continued;
  // and leaves to be put back in the order of their rows, all but the last
  // one full. Both give an empty one in exchange.
  long leaf_rows() const { return leaf_rows_; }
  void TakeLeaf(LeafFactor* leaf);
  void PutLeaf(LeafFactor* leaf);

 private:
  void CloseLeaf();

  long leaf_rows_;
  LeafFactor leaf_;  // under way
  long leaves_ = 0;
  std::vector<Eigen::MatrixXd> tree_;  // [k]: of 2^k leaves, or empty
  long merged_rows_ = 0;
  Eigen::MatrixXd merged_;            // of other factors
  mutable Eigen::MatrixXd triangle_;  // empty: not up to date
};

}  // namespace armcal

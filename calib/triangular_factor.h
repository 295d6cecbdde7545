#pragma once

#include <Eigen/Core>

namespace armcal {

// The triangular factor of linear equations [A | y], updated by Householder QR
// as rows come in: the memory of a triangle and one chunk of rows.
class TriangularFactor {
 public:
  explicit TriangularFactor(int columns);
  // Of `rows` equations whose triangle is known.
  TriangularFactor(const Eigen::MatrixXd& triangle, long rows);

  int columns() const { return columns_; }
  long rows() const { return rows_; }
  // Adds weight * (row x = y).
  template <class Row>
  void Add(const Row& row, double y, double weight) {
    auto next = Next();
    next.head(columns_) = weight * row;
    next[columns_] = weight * y;
    ++rows_;
  }
  void Merge(const TriangularFactor& other);
  // Upper triangle of columns() + 1, the right side last.
  Eigen::MatrixXd Triangle() const;

 private:
  static constexpr int kChunkRows = 256;
  Eigen::MatrixXd::RowXpr Next();
  void Compress() const;

  int columns_;
  long rows_ = 0;
  // The triangle in the top rows, new rows below it.
  mutable Eigen::MatrixXd buffer_;
  mutable int filled_ = 0;
};

}  // namespace armcal

#include "calib/triangular_factor.h"

#include <glog/logging.h>

#include <Eigen/QR>

namespace armcal {

using Eigen::MatrixXd;

TriangularFactor::TriangularFactor(int columns)
    : columns_(columns),
      buffer_(MatrixXd::Zero(columns + 1 + kChunkRows, columns + 1)) {}

TriangularFactor::TriangularFactor(const MatrixXd& triangle, long rows)
    : TriangularFactor(static_cast<int>(triangle.cols()) - 1) {
  buffer_.topRows(columns_ + 1) = triangle;
  rows_ = rows;
}

MatrixXd::RowXpr TriangularFactor::Next() {
  if (filled_ == kChunkRows) Compress();
  return buffer_.row(columns_ + 1 + filled_++);
}

void TriangularFactor::Compress() const {
  if (filled_ == 0) return;
  const int k = columns_ + 1;
  Eigen::Ref<MatrixXd> used = buffer_.topRows(k + filled_);
  const Eigen::HouseholderQR<Eigen::Ref<MatrixXd>> qr(used);
  buffer_.topRows(k).triangularView<Eigen::StrictlyLower>().setZero();
  filled_ = 0;
}

void TriangularFactor::Merge(const TriangularFactor& other) {
  CHECK_EQ(other.columns_, columns_);
  const MatrixXd R = other.Triangle();
  for (Eigen::Index r = 0; r < R.rows(); ++r) Next() = R.row(r);
  rows_ += other.rows_;
}

MatrixXd TriangularFactor::Triangle() const {
  Compress();
  return buffer_.topRows(columns_ + 1);
}

}  // namespace armcal

#include "calib/numerics/leaf_factor.h"

#include <glog/logging.h>

#include <algorithm>
#include <new>

#include "model/simd/kernels.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;

constexpr std::align_val_t kAlignment{64};  // of the longest lanes

double* NewChunk(long size) {
  return static_cast<double*>(
      ::operator new(size * sizeof(double), kAlignment));
}

// The first `rows` rows of a chunk into the triangle.
void Reduce(double* chunk, long rows, MatrixXd* triangle) {
  const long whole = (rows + 7) / 8 * 8;
  for (Eigen::Index c = 0; c < triangle->cols(); ++c) {
    double* column = chunk + c * LeafFactor::kStride;
    std::fill(column + rows, column + whole, 0.0);
  }
  simd::BestKernels().householder(triangle->data(), triangle->rows(),
                                  static_cast<int>(triangle->cols()), chunk,
                                  LeafFactor::kStride, whole, false);
}

}  // namespace

void LeafFactor::Free::operator()(double* chunk) const {
  ::operator delete(chunk, kAlignment);
}

LeafFactor::LeafFactor(int columns)
    : triangle_(MatrixXd::Zero(columns + 1, columns + 1)),
      chunk_(NewChunk(size())) {}

LeafFactor::LeafFactor(const LeafFactor& other)
    : rows_(other.rows_), triangle_(other.triangle_), chunk_(NewChunk(size())) {
  for (Eigen::Index c = 0; c < triangle_.cols(); ++c) {
    std::copy_n(other.chunk_.get() + c * kStride, filled(),
                chunk_.get() + c * kStride);
  }
}

void LeafFactor::Clear() {
  rows_ = 0;
  triangle_.setZero();
}

void LeafFactor::Commit(long rows) {
  DCHECK_LE(rows, room());
  rows_ += rows;
  if (rows > 0 && filled() == 0) Reduce(chunk_.get(), kChunkRows, &triangle_);
}

MatrixXd LeafFactor::Triangle() const {
  if (filled() == 0) return triangle_;
  LeafFactor copy(*this);
  Reduce(copy.chunk_.get(), filled(), &copy.triangle_);
  return std::move(copy.triangle_);
}

MatrixXd MergeTriangles(const MatrixXd& first, const MatrixXd& second) {
  CHECK_EQ(first.cols(), second.cols());
  const Eigen::Index size = second.cols(), whole = (size + 7) / 8 * 8;
  MatrixXd R = first, below = MatrixXd::Zero(whole, size);
  below.topRows(size) = second;
  simd::BestKernels().householder(R.data(), size, static_cast<int>(size),
                                  below.data(), whole, whole, true);
  return R;
}

}  // namespace armcal

#include "calib/numerics/block_tridiagonal_factor.h"

#include <glog/logging.h>

#include <Eigen/Cholesky>
#include <algorithm>

namespace armcal {

using Eigen::Lower;
using Eigen::MatrixXd;

BlockTridiagonalFactor::Blocks::Blocks(int count, int size)
    : diagonal(count, MatrixXd::Zero(size, size)),
      lower(count - 1, MatrixXd::Zero(size, size)) {}

void BlockTridiagonalFactor::Blocks::Add(int begin, const MatrixXd& square) {
  const int b = block_size(), k = begin / b, row = begin % b;
  const int size = static_cast<int>(square.rows());
  const int head = std::min(size, b - row), tail = size - head;
  CHECK_LE(tail, b);
  diagonal[k].block(row, row, head, head) += square.topLeftCorner(head, head);
  if (tail == 0) return;
  diagonal[k + 1].topLeftCorner(tail, tail) +=
      square.bottomRightCorner(tail, tail);
  lower[k].block(0, row, tail, head) += square.bottomLeftCorner(tail, head);
}

MatrixXd BlockTridiagonalFactor::Blocks::Square(int begin, int size) const {
  const int b = block_size(), k = begin / b, row = begin % b;
  const int head = std::min(size, b - row), tail = size - head;
  MatrixXd square(size, size);
  square.topLeftCorner(head, head) = diagonal[k].block(row, row, head, head);
  if (tail == 0) return square;
  square.bottomRightCorner(tail, tail) =
      diagonal[k + 1].topLeftCorner(tail, tail);
  square.bottomLeftCorner(tail, head) = lower[k].block(0, row, tail, head);
  square.topRightCorner(head, tail) =
      square.bottomLeftCorner(tail, head).transpose();
  return square;
}

BlockTridiagonalFactor::BlockTridiagonalFactor(const Blocks& matrix)
    : L_(matrix) {
  for (size_t k = 0; k < L_.diagonal.size(); ++k) {
    MatrixXd& L = L_.diagonal[k];
    if (k > 0) L -= L_.lower[k - 1] * L_.lower[k - 1].transpose();
    const Eigen::LLT<MatrixXd> llt(L);
    positive_ = positive_ && llt.info() == Eigen::Success;
    if (!positive_) return;
    L = llt.matrixL();
    if (k + 1 == L_.diagonal.size()) return;
    L.triangularView<Lower>().transpose().solveInPlace<Eigen::OnTheRight>(
        L_.lower[k]);
  }
}

MatrixXd BlockTridiagonalFactor::Solve(const MatrixXd& right) const {
  CHECK(positive_);
  const int b = L_.block_size(), count = static_cast<int>(L_.diagonal.size());
  MatrixXd y = right;
  for (int k = 0; k < count; ++k) {
    auto row = y.middleRows(k * b, b);
    if (k > 0) row -= L_.lower[k - 1] * y.middleRows((k - 1) * b, b);
    L_.diagonal[k].triangularView<Lower>().solveInPlace(row);
  }
  for (int k = count - 1; k >= 0; --k) {
    auto row = y.middleRows(k * b, b);
    if (k + 1 < count) {
      row -= L_.lower[k].transpose() * y.middleRows((k + 1) * b, b);
    }
    L_.diagonal[k].triangularView<Lower>().transpose().solveInPlace(row);
  }
  return y;
}

BlockTridiagonalFactor::Blocks BlockTridiagonalFactor::Inverse() const {
  CHECK(positive_);
  const int b = L_.block_size(), count = static_cast<int>(L_.diagonal.size());
  Blocks inverse(count, b);
  for (int k = count - 1; k >= 0; --k) {
    const MatrixXd W =
        L_.diagonal[k].triangularView<Lower>().solve(MatrixXd::Identity(b, b));
    inverse.diagonal[k] = W.transpose() * W;
    if (k + 1 == count) continue;
    const MatrixXd F = L_.lower[k] * W;
    inverse.lower[k] = -inverse.diagonal[k + 1] * F;
    inverse.diagonal[k] -= F.transpose() * inverse.lower[k];
  }
  return inverse;
}

}  // namespace armcal

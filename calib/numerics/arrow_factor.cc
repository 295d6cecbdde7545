#include "calib/numerics/arrow_factor.h"

#include <utility>

namespace armcal {

using Eigen::MatrixXd;

namespace {

double LogDeterminantOf(const Eigen::LLT<MatrixXd>& factor) {
  return 2 * factor.matrixLLT().diagonal().array().log().sum();
}

}  // namespace

ArrowFactor::ArrowFactor(const MatrixXd& A, std::vector<std::vector<int>> arms)
    : size_(static_cast<int>(A.rows())) {
  std::vector<bool> is_common(size_, true);
  for (std::vector<int>& indices : arms) {
    for (const int i : indices) is_common[i] = false;
    arms_.push_back({std::move(indices), {}, {}});
  }
  for (int i = 0; i < size_; ++i) {
    if (is_common[i]) common_.push_back(i);
  }
  MatrixXd schur = A(common_, common_);
  for (Arm& arm : arms_) {
    arm.factor.compute(A(arm.indices, arm.indices));
    arm.coupling =
        arm.factor.matrixL().solve(MatrixXd(A(arm.indices, common_)));
    schur.noalias() -= arm.coupling.transpose() * arm.coupling;
  }
  schur_.compute(schur);
}

MatrixXd ArrowFactor::HalfOfArm(int k, const MatrixXd& b) const {
  return arms_[k].factor.matrixL().solve(b);
}

MatrixXd ArrowFactor::HalfOfCommon(const MatrixXd& b) const {
  return schur_.matrixL().solve(b);
}

MatrixXd ArrowFactor::Solve(const MatrixXd& b) const {
  MatrixXd x(size_, b.cols());
  MatrixXd common = b(common_, Eigen::all);
  std::vector<MatrixXd> half;
  for (const Arm& arm : arms_) {
    half.push_back(
        arm.factor.matrixL().solve(MatrixXd(b(arm.indices, Eigen::all))));
    common.noalias() -= arm.coupling.transpose() * half.back();
  }
  common = schur_.solve(common).eval();
  x(common_, Eigen::all) = common;
  for (size_t k = 0; k < arms_.size(); ++k) {
    const MatrixXd own = arms_[k].factor.matrixU().solve(
        MatrixXd(half[k] - arms_[k].coupling * common));
    x(arms_[k].indices, Eigen::all) = own;
  }
  return x;
}

double ArrowFactor::LogDeterminant() const {
  double sum = LogDeterminantOf(schur_);
  for (const Arm& arm : arms_) sum += LogDeterminantOf(arm.factor);
  return sum;
}

// The block inverse: with S^-1 of the common ones and K = L_k^-T H_k,
//   [ D_k^-1 + K S^-1 K'   -K S^-1 ]
//   [ -S^-1 K'              S^-1   ].
MatrixXd ArrowFactor::InverseBeside(int k) const {
  const Arm& arm = arms_[k];
  const Eigen::Index p = static_cast<Eigen::Index>(arm.indices.size());
  const Eigen::Index c = static_cast<Eigen::Index>(common_.size());
  const MatrixXd common = schur_.solve(MatrixXd::Identity(c, c));
  const MatrixXd K = arm.factor.matrixU().solve(arm.coupling);
  MatrixXd inverse(p + c, p + c);
  inverse.bottomRightCorner(c, c) = common;
  inverse.topRightCorner(p, c).noalias() = -K * common;
  inverse.bottomLeftCorner(c, p) = inverse.topRightCorner(p, c).transpose();
  inverse.topLeftCorner(p, p) = arm.factor.solve(MatrixXd::Identity(p, p));
  inverse.topLeftCorner(p, p).noalias() -=
      inverse.topRightCorner(p, c) * K.transpose();
  return inverse;
}

}  // namespace armcal

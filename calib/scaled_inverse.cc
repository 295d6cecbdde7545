#include "calib/scaled_inverse.h"

#include <Eigen/Cholesky>

namespace armcal {

Eigen::MatrixXd ScaledInverse(const Eigen::MatrixXd& A,
                              const std::vector<int>& kept) {
  const Eigen::MatrixXd part = A(kept, kept);
  const Eigen::VectorXd s = part.diagonal().cwiseSqrt().cwiseInverse();
  const Eigen::MatrixXd scaled = s.asDiagonal() * part * s.asDiagonal();
  const auto one = Eigen::MatrixXd::Identity(part.rows(), part.cols());
  Eigen::MatrixXd inverse = Eigen::MatrixXd::Zero(A.rows(), A.cols());
  inverse(kept, kept) =
      s.asDiagonal() * scaled.ldlt().solve(one) * s.asDiagonal();
  return inverse;
}

}  // namespace armcal

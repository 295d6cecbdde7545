#include "calib/singular_values.h"

#include "model/dense_solvers.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;

// Not where there is a NaN, which norms keep.
bool IsOrthonormal(const MatrixXd& X) {
  const MatrixXd one = MatrixXd::Identity(X.cols(), X.cols());
  return (X.transpose() * X - one).norm() < 1e-10;
}

bool IsOf(const MatrixXd& A, const SingularValues& svd) {
  const auto product =
      svd.U * svd.s.asDiagonal() * svd.V.leftCols(svd.s.size()).transpose();
  return IsOrthonormal(svd.U) && IsOrthonormal(svd.V) &&
         (product - A).norm() <= 1e-12 * A.norm();
}

template <class Decomposition>
SingularValues Decompose(const MatrixXd& A) {
  const Decomposition svd(A, Eigen::ComputeThinU | Eigen::ComputeFullV);
  return {svd.matrixU(), svd.singularValues(), svd.matrixV()};
}

}  // namespace

SingularValues DecomposeSingular(const MatrixXd& A) {
  const SingularValues quick = Decompose<Eigen::BDCSVD<MatrixXd>>(A);
  return IsOf(A, quick) ? quick : Decompose<Eigen::JacobiSVD<MatrixXd>>(A);
}

}  // namespace armcal

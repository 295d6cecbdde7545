#include "model/dense_solvers.h"

template class Eigen::BDCSVD<Eigen::MatrixXd>;
template class Eigen::JacobiSVD<Eigen::MatrixXd>;
template class Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>;

namespace armcal {

using Eigen::MatrixXd;

SingularValues DecomposeSingular(const MatrixXd& A) {
  constexpr auto kBoth = Eigen::ComputeThinU | Eigen::ComputeFullV;
  const Eigen::BDCSVD<MatrixXd> quick(A, kBoth);
  SingularValues result{quick.matrixU(), quick.singularValues(),
                        quick.matrixV()};
  if (result.s.allFinite() && result.U.allFinite() && result.V.allFinite()) {
    return result;
  }
  const Eigen::JacobiSVD<MatrixXd> sure(A, kBoth);
  return {sure.matrixU(), sure.singularValues(), sure.matrixV()};
}

}  // namespace armcal

#include "calib/singular_values.h"

#include "model/dense_solvers.h"

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

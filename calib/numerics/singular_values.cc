#include "calib/numerics/singular_values.h"

#include "model/signals/dense_solvers.h"

namespace armcal {

SingularValues DecomposeSingular(const Eigen::MatrixXd& A) {
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(
      A, Eigen::ComputeThinU | Eigen::ComputeFullV);
  return {svd.matrixU(), svd.singularValues(), svd.matrixV()};
}

}  // namespace armcal

#include "calib/poses/seen_unknowns.h"

#include <Eigen/SVD>

namespace armcal {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// Columns are scaled to one length: metres and radians are no measure of what
// is seen.
SeenUnknowns::SeenUnknowns(const MatrixXd& A) {
  const VectorXd scale = A.colwise().norm().cwiseMax(1e-300);
  const Eigen::JacobiSVD<MatrixXd> svd(A * scale.cwiseInverse().asDiagonal(),
                                       Eigen::ComputeThinV);
  const VectorXd& s = svd.singularValues();
  const Eigen::Index rank = (s.array() > 1e-9 * s[0]).count();
  const MatrixXd& V = svd.matrixV();
  half = scale.cwiseInverse().asDiagonal() * V.leftCols(rank) *
         s.head(rank).cwiseInverse().asDiagonal();
  unseen = V.rightCols(V.cols() - rank).rowwise().squaredNorm();
}

}  // namespace armcal

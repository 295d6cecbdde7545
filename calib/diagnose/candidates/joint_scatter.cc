#include "calib/diagnose/candidates/joint_scatter.h"

#include <Eigen/QR>
#include <cmath>

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// J's column k without what its other columns explain of it.
VectorXd OwnSlopes(const RowMajorMatrix& J, int k) {
  MatrixXd others = J;
  others.col(k).setZero();
  return J.col(k) -
         others * others.completeOrthogonalDecomposition().solve(J.col(k));
}

// Of one parameter with these slopes; 0 where one joint alone depends on it.
double VarianceByJoints(const VectorXd& slopes, const VectorXd& residual,
                        const std::vector<int>& rows_of_joint) {
  double sum = 0, joints = 0;
  Eigen::Index begin = 0;
  for (const int rows : rows_of_joint) {
    const auto own = slopes.segment(begin, rows);
    const double score = own.dot(residual.segment(begin, rows));
    begin += rows;
    if (own.isZero(0)) continue;
    sum += score * score;
    ++joints;
  }
  const double information = slopes.squaredNorm();
  if (joints < 2 || !(information > 0)) return 0;
  return joints / (joints - 1) * sum / (information * information);
}

}  // namespace

MatrixXd WidenByJoints(const MatrixXd& covariance, const RowMajorMatrix& J,
                       const VectorXd& residual,
                       const std::vector<int>& rows_of_joint,
                       const std::vector<int>& which) {
  MatrixXd widened = covariance;
  if (!residual.allFinite() || !J.allFinite()) return widened;
  for (const int k : which) {
    if (!(widened(k, k) > 0)) continue;
    const double variance =
        VarianceByJoints(OwnSlopes(J, k), residual, rows_of_joint);
    if (variance <= widened(k, k)) continue;
    const double factor = std::sqrt(variance / widened(k, k));
    widened.row(k) *= factor;
    widened.col(k) *= factor;
  }
  return widened;
}

}  // namespace armcal

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

}  // namespace

std::vector<int> JointsOfRows(const GapRows& rows) {
  std::vector<int> joints;
  for (int j = 0; j < rows.num_joints(); ++j) {
    joints.insert(joints.end(), rows.PlacesOfRows(j).size(), j);
  }
  return joints;
}

MatrixXd WidenByJoints(const MatrixXd& covariance, const RowMajorMatrix& J,
                       const VectorXd& residual,
                       const std::vector<int>& joint_of_row,
                       const std::vector<int>& which) {
  MatrixXd widened = covariance;
  for (const int k : which) {
    if (!(widened(k, k) > 0)) continue;
    const double variance =
        BlockCovariance(OwnSlopes(J, k), residual, joint_of_row)(0, 0);
    if (variance <= widened(k, k)) continue;
    const double factor = std::sqrt(variance / widened(k, k));
    widened.row(k) *= factor;
    widened.col(k) *= factor;
  }
  return widened;
}

}  // namespace armcal

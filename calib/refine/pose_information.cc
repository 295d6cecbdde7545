#include "calib/refine/pose_information.h"

#include <cmath>
#include <vector>

#include "calib/numerics/posterior.h"
#include "calib/poses/seen_unknowns.h"
#include "calib/poses/shared_errors.h"

namespace armcal {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// With the factor V that a robust loss makes of the variance (VarianceFactor),
// A = J / root V; its square is then the inverse of a covariance. In these
// units the pull has the covariance J'Q B Q'J / V^2 (PoseScoreCovariance),
// which is A'A where B = V.
PoseInformation InformByPoses(const ArmUnknowns& unknowns, const PoseFit* poses,
                              const ArmValues& at) {
  const MatrixXd none = MatrixXd::Zero(0, unknowns.size());
  if (poses == nullptr) return {none, none};
  const std::vector<int> all = poses->AllRows();
  VectorXd residuals;
  const MatrixXd by_all = poses->Jacobian(all, at.poses, &residuals);
  std::vector<int> free;
  for (int k = 0; k < by_all.cols(); ++k) {
    if (unknowns.is_free(unknowns.geometry_begin() + k)) free.push_back(k);
  }
  const double variance =
      poses->VarianceFactor(residuals, static_cast<int>(free.size()));
  const MatrixXd J = by_all(Eigen::all, free);
  const MatrixXd Q = J * SeenUnknowns(J).half;
  const MatrixXd B = PoseScoreCovariance(*poses, all, by_all, residuals, Q);
  const auto at_their_places = [&](const MatrixXd& columns) {
    MatrixXd placed = MatrixXd::Zero(columns.rows(), unknowns.size());
    placed.rightCols(columns.cols()) = columns;
    return placed;
  };
  return {at_their_places(by_all / std::sqrt(variance)),
          at_their_places(SquareRoot(B) * (Q.transpose() * by_all) / variance)};
}

}  // namespace armcal

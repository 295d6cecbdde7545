#include "model/robot/dh_row.h"

#include <cmath>

namespace armcal {

using Eigen::Matrix3d;

std::optional<DhParameters> DhRow(const Link& link, DhConvention convention) {
  const bool standard = convention == DhConvention::kStandard;
  const Matrix3d& Z = link.X_ML.linear();
  const Matrix3d& X = standard ? Z : link.X_PF.linear();
  DhParameters dh;
  dh.theta = std::atan2(Z(1, 0), Z(0, 0));
  dh.alpha = std::atan2(X(2, 1), X(2, 2));
  dh.d = link.X_ML.translation().z();
  dh.a = standard ? link.X_ML.translation().dot(Z.col(0))
                  : link.X_PF.translation().x();
  Link made;
  SetDhPose(dh, convention, &made);
  if ((made.X_PF.matrix() - link.X_PF.matrix()).norm() > 1e-12 ||
      (made.X_ML.matrix() - link.X_ML.matrix()).norm() > 1e-12) {
    return std::nullopt;
  }
  return dh;
}

}  // namespace armcal

#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <vector>

#include "model/robot/arm_geometry.h"

namespace armcal {

// Of an arm whose tool T is seen from W: the base B, and T on the flange E.
struct HandEye {
  Eigen::Isometry3d X_WB, X_ET;
};

// The frames of X_WT = X_WB X_BE X_ET, a pose of the flange and of what was
// seen for each posture, in closed form. Both rotations first: the entries of
// R_BW and R_ET that minimise sum |R_BW R_WT - R_BE R_ET|^2 are a singular
// vector, of which the nearest rotations are taken (as Shah 2013, Solving the
// robot-world/hand-eye calibration problem using the Kronecker product); then
// the translations by linear least squares. Nothing where the postures do not
// turn the flange about two axes.
std::optional<HandEye> SolveHandEye(const std::vector<Eigen::Isometry3d>& X_BE,
                                    const std::vector<Eigen::Isometry3d>& X_WT);

// The same of an arm with the geometry `values` in postures q (rows), whatever
// these have for base and tool.
std::optional<HandEye> SolveHandEye(const ArmGeometry& geometry,
                                    Eigen::VectorXd values,
                                    const Eigen::MatrixXd& q,
                                    const std::vector<Eigen::Isometry3d>& X_WT);

}  // namespace armcal

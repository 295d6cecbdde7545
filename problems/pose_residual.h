#pragma once

#include <ceres/cost_function.h>

#include <Eigen/Geometry>
#include <memory>

#include "model/robot/arm_geometry.h"

namespace armcal {

// A measured pose X_WM of the tool:
//   r = (p_WT - p_WM) / sigma_m, rotation vector of R_WT R_WM' / sigma_rad (6),
// T the tool at q. Parameter block: g, the geometry's parameters.
class PoseResidual : public ceres::CostFunction {
 public:
  PoseResidual(std::shared_ptr<const ArmGeometry> geometry,
               const Eigen::VectorXd& q, const Eigen::Isometry3d& X_WM,
               double sigma_m, double sigma_rad);
  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override;

 private:
  std::shared_ptr<const ArmGeometry> geometry_;
  Eigen::VectorXd q_;
  Eigen::Isometry3d X_WM_;
  double sigma_m_, sigma_rad_;
};

}  // namespace armcal

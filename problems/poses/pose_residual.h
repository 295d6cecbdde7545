#pragma once

#include <ceres/cost_function.h>

#include <Eigen/Geometry>
#include <memory>

#include "model/log_files/pose_reader.h"
#include "model/robot/arm_geometry.h"

namespace armcal {

// A measured pose X_WM of the tool:
//   r = W ((p_WT - p_WM, rotation vector of R_WT R_WM') - G y)     (6),
// T the tool at q, W what makes these errors (m, rad) independent and alike, y
// the instrument's unknowns, which move what it measured by G y. Parameter
// blocks: g, the geometry's parameters, and y where there are such.
class PoseResidual : public ceres::CostFunction {
 public:
  PoseResidual(std::shared_ptr<const ArmGeometry> geometry,
               const Eigen::VectorXd& q, const Eigen::Isometry3d& X_WM,
               const Matrix6d& whitening,
               Eigen::MatrixXd by_instrument = Eigen::MatrixXd(6, 0));
  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override;

 private:
  std::shared_ptr<const ArmGeometry> geometry_;
  Eigen::VectorXd q_;
  Eigen::Isometry3d X_WM_;
  Matrix6d whitening_;
  Eigen::MatrixXd by_instrument_;  // 6 x unknowns
};

}  // namespace armcal

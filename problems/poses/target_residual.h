#pragma once

#include <ceres/cost_function.h>

#include <Eigen/Core>
#include <memory>

#include "model/robot/arm_geometry.h"

namespace armcal {

// A target on the tool seen by a tracker:
//   r = (X_WT(q; g) p_TQ - p_WQ) / sigma     (3), W the tracker's frame.
// Parameter blocks: g, the geometry's parameters (ArmGeometry::Values); p_TQ,
// the target on the tool (3, m).
class TargetResidual : public ceres::CostFunction {
 public:
  TargetResidual(std::shared_ptr<const ArmGeometry> geometry,
                 const Eigen::VectorXd& q, const Eigen::Vector3d& p_WQ,
                 double sigma);
  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override;

 private:
  std::shared_ptr<const ArmGeometry> geometry_;
  Eigen::VectorXd q_;
  Eigen::Vector3d p_WQ_;
  double sigma_;
};

}  // namespace armcal

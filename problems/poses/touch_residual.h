#pragma once

#include <ceres/cost_function.h>

#include <Eigen/Core>
#include <memory>

#include "model/robot/arm_geometry.h"

namespace armcal {

// The tool's tip at a point that it touches in several postures and whose place
// nobody knows:
//   r = (p_WT(q; g) - p_WQ) / sigma     (3).
// Parameter blocks: g, the geometry's parameters; p_WQ, the point (3, m).
class TouchResidual : public ceres::CostFunction {
 public:
  TouchResidual(std::shared_ptr<const ArmGeometry> geometry,
                const Eigen::VectorXd& q, double sigma);
  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override;

 private:
  std::shared_ptr<const ArmGeometry> geometry_;
  Eigen::VectorXd q_;
  double sigma_;
};

}  // namespace armcal

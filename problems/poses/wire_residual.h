#pragma once

#include <ceres/cost_function.h>

#include <Eigen/Core>
#include <memory>

#include "model/robot/arm_geometry.h"

namespace armcal {

// A wire drawn from a fixed anchor A to the tool:
//   r = (|p_WT(q; g) - p_WA| + offset - length) / sigma     (1).
// Parameter blocks: g, the geometry's parameters; (p_WA, offset), 4, m.
class WireResidual : public ceres::CostFunction {
 public:
  WireResidual(std::shared_ptr<const ArmGeometry> geometry,
               const Eigen::VectorXd& q, double length, double sigma);
  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override;

 private:
  std::shared_ptr<const ArmGeometry> geometry_;
  Eigen::VectorXd q_;
  double length_, sigma_;
};

}  // namespace armcal

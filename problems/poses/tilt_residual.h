#pragma once

#include <ceres/cost_function.h>

#include <Eigen/Core>
#include <memory>

#include "model/robot/arm_geometry.h"

namespace armcal {

// How far an inclinometer's axes rise above the horizontal: with u the upward
// direction in the tool's frame T, u = R_WT(q; g)' e_z (W's z is up),
//   r_i = (u_i - sin t_i) / (sigma cos t_i)     (2: i = x, y),
// t the measured angles: an error of sigma rad of an angle is one of sigma cos
// t of its sine, which is what accelerometers measure. Parameter block: g, the
// geometry's parameters.
class TiltResidual : public ceres::CostFunction {
 public:
  TiltResidual(std::shared_ptr<const ArmGeometry> geometry,
               const Eigen::VectorXd& q, const Eigen::Vector2d& tilt,
               double sigma);
  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override;

 private:
  std::shared_ptr<const ArmGeometry> geometry_;
  Eigen::VectorXd q_;
  Eigen::Vector2d tilt_;
  double sigma_;
};

// The same of a tool that stands so, in rad.
Eigen::Vector2d TiltErrors(const Eigen::Matrix3d& R_WT,
                           const Eigen::Vector2d& tilt);

}  // namespace armcal

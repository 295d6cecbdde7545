#pragma once

#include <ceres/cost_function.h>

#include "model/inertial_parameters.h"

namespace armcal {

// Ties a link's inertial parameters V to those of the robot file, V_0:
//   r = vec(A^-1 (P(V) - P(V_0)) A^-T) / trust   (10), A A' = P(V_0),
// the pseudo-inertia's relative deviation in every direction: to second order
// the log-determinant divergence (Lee, Wensing and Park 2020), independent of
// units and frames. Off-diagonal entries count sqrt(2). Parameter block: V in
// log-Cholesky coordinates.
class InertialPrior : public ceres::CostFunction {
 public:
  InertialPrior(const Vector10d& V_0, double trust);
  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override;
  // The prior's information about V: r = W (V - V_0).
  const Eigen::Matrix<double, 10, 10>& W() const { return W_; }

 private:
  Vector10d V_0_;
  Eigen::Matrix<double, 10, 10> W_;
};

}  // namespace armcal

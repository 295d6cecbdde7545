#pragma once

#include <ceres/cost_function.h>

#include "model/robot/inertial_parameters.h"

namespace armcal {

// Ties a link's inertial parameters V to those of the robot file, V_0, by the
// log-determinant divergence of the pseudo-inertias (Lee, Wensing and Park
// 2020), independent of units and frames:
//   |r|^2 = 2 (tr X - log det X - 4) / trust^2,   P(V) = A X A', A A' = P(V_0).
// Near V_0 it is |vec(X - 1)|^2 / trust^2, the relative deviation in every
// direction; towards bodies that cannot exist it grows without bound. With
// X = C C', C upper triangular, a residual is sqrt(2) C_ij for every entry
// off the diagonal and h(C_ii)^2 = 2 (C_ii^2 - 1 - 2 log C_ii) for every one on
// it. Parameter block: V in log-Cholesky coordinates.
class InertialPrior : public ceres::CostFunction {
 public:
  InertialPrior(const Vector10d& V_0, double trust);
  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override;
  // Near V_0, up to a rotation, r = W (V - V_0): the information about V.
  const Eigen::Matrix<double, 10, 10>& W() const { return W_; }

 private:
  Vector10d c_0_;  // V_0 in coordinates
  double trust_;
  Eigen::Matrix<double, 10, 10> W_;
};

}  // namespace armcal

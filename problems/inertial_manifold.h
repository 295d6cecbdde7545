#pragma once

#include <ceres/manifold.h>

namespace armcal {

// Steps in log-Cholesky coordinates that are straight in the inertial
// parameters, so that equations linear in these stay so for a solver, however
// narrow their valley is in the coordinates: with the pseudo-inertia C C',
//   Plus(C, D) = C (1 + D) C',
// D symmetric, its entries (0,0) (1,1) (2,2) (3,3) (0,1) (0,2) (0,3) (1,2)
// (1,3) (2,3): the pseudo-inertia's relative change. Steps that would leave no
// body, or less than a hundredth of it in some direction, end short of that.
class InertialManifold : public ceres::Manifold {
 public:
  int AmbientSize() const override { return 10; }
  int TangentSize() const override { return 10; }
  bool Plus(const double* x, const double* delta,
            double* x_plus_delta) const override;
  bool PlusJacobian(const double* x, double* jacobian) const override;
  bool Minus(const double* y, const double* x,
             double* y_minus_x) const override;
  bool MinusJacobian(const double* x, double* jacobian) const override;
};

}  // namespace armcal

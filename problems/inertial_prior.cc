#include "problems/inertial_prior.h"

#include <ceres/jet.h>

#include <Eigen/Cholesky>
#include <cmath>

#include "problems/inertial_coordinates.h"

namespace armcal {

using Matrix10d = Eigen::Matrix<double, 10, 10>;

InertialPrior::InertialPrior(const Vector10d& V_0, double trust) {
  set_num_residuals(10);
  *mutable_parameter_block_sizes() = {10};
  // A file's inertia on or beyond the boundary is moved inside.
  const Vector10d c = LogCholeskyFromInertial(V_0, 0.01, 0.01);
  InertialFromLogCholesky(c.data(), V_0_.data());
  const Eigen::Matrix4d A = PseudoInertia(V_0_).llt().matrixL();
  for (int k = 0; k < 10; ++k) {
    const Eigen::Matrix4d P = PseudoInertia(Vector10d::Unit(k));
    const Eigen::Matrix4d half =
        A.triangularView<Eigen::Lower>().solve(P).transpose();
    const Eigen::Matrix4d relative =
        A.triangularView<Eigen::Lower>().solve(half);
    int row = 0;
    for (int i = 0; i < 4; ++i) {
      for (int j = 0; j <= i; ++j) {
        W_(row++, k) = relative(i, j) * (i == j ? 1 : std::sqrt(2.0)) / trust;
      }
    }
  }
}

bool InertialPrior::Evaluate(double const* const* parameters, double* residuals,
                             double** jacobians) const {
  using Jet10 = ceres::Jet<double, 10>;
  Jet10 c[10], V[10];
  for (int k = 0; k < 10; ++k) c[k] = Jet10(parameters[0][k], k);
  InertialFromLogCholesky(c, V);
  Vector10d value;
  Matrix10d J;
  for (int k = 0; k < 10; ++k) {
    value[k] = V[k].a;
    J.row(k) = V[k].v.transpose();
  }
  Eigen::Map<Vector10d> r(residuals);
  r = W_ * (value - V_0_);
  if (jacobians != nullptr && jacobians[0] != nullptr) {
    Eigen::Map<Eigen::Matrix<double, 10, 10, Eigen::RowMajor>> d(jacobians[0]);
    d = W_ * J;
  }
  return r.allFinite();
}

}  // namespace armcal

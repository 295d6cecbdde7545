#include "problems/inertial_prior.h"

#include <ceres/jet.h>

#include <Eigen/Cholesky>
#include <cmath>

#include "problems/inertial_coordinates.h"

namespace armcal {

using Matrix10d = Eigen::Matrix<double, 10, 10>;

// The signed root h(e^x) of 2 (e^2x - 1 - 2x), which is the divergence of a
// diagonal entry C = e^x. A solver wants residuals whose squares are the cost,
// and the root has to change sign with x: |h| has a kink at 0, where the solver
// comes to rest. Near 0 the difference e^2x - 1 - 2x cancels to nothing, and
// the series 2 x (1 + x/3 + x^2/9 + ..) takes its place.
template <class T>
T SignedRoot(const T& x) {
  using std::abs;
  using std::exp;
  using std::sqrt;
  if (abs(x) < T(1e-3)) {
    return T(2) * x * (T(1) + x / T(3) + x * x / T(9));
  }
  const T h = sqrt(T(2) * (exp(T(2) * x) - T(1) - T(2) * x));
  return x < T(0) ? T(-h) : h;
}

// W is the prior's square root of information about V itself, at V_0. For a
// change P of the pseudo-inertia A A' the divergence is, to second order,
//   |A^-1 P A^-T|^2 / trust^2  (Frobenius norm),
// P relative to what the link has. W's column k holds the entries for a unit of
// parameter k, those off the diagonal once and by sqrt(2), as the norm counts
// them twice.
InertialPrior::InertialPrior(const Vector10d& V_0, double trust)
    : c_0_(LogCholeskyFromInertial(V_0, 0.01, 0.01)), trust_(trust) {
  set_num_residuals(10);
  *mutable_parameter_block_sizes() = {10};
  // A file's inertia on or beyond the boundary is moved inside.
  Vector10d inside;
  InertialFromLogCholesky(c_0_.data(), inside.data());
  const Eigen::Matrix4d A = PseudoInertia(inside).llt().matrixL();
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

// Residuals of V in log-Cholesky coordinates. Both pseudo-inertias are products
// of upper triangular factors, e^(2a) U U', so that
//   C = e^(a - a_0) U_0^-1 U
// is upper triangular, too, and X = C C' is V's pseudo-inertia as V_0 sees it.
// The logarithms of C's diagonal are differences of coordinates. They are taken
// as such and not from C, whose exponentials overflow far away.
bool InertialPrior::Evaluate(double const* const* parameters, double* residuals,
                             double** jacobians) const {
  using Jet10 = ceres::Jet<double, 10>;
  Jet10 c[10];
  for (int k = 0; k < 10; ++k) c[k] = Jet10(parameters[0][k], k);
  const Eigen::Matrix4d U_0_inverse = LogCholeskyFactor(c_0_.data())
                                          .triangularView<Eigen::Upper>()
                                          .solve(Eigen::Matrix4d::Identity());
  const Jet10 scale = exp(c[0] - c_0_[0]);
  const Eigen::Matrix<Jet10, 4, 4> C =
      scale * (U_0_inverse.cast<Jet10>() * LogCholeskyFactor(c));
  Vector10d value;
  Matrix10d J;
  const auto set = [&](int row, const Jet10& r) {
    value[row] = r.a / trust_;
    J.row(row) = r.v.transpose() / trust_;
  };
  int row = 0;
  for (int i = 0; i < 4; ++i) {
    const Jet10 depth = i < 3 ? c[1 + i] - c_0_[1 + i] : Jet10(0);
    set(row++, SignedRoot(Jet10(c[0] - c_0_[0] + depth)));
    for (int j = i + 1; j < 4; ++j) set(row++, std::sqrt(2.0) * C(i, j));
  }
  Eigen::Map<Vector10d> r(residuals);
  r = value;
  if (jacobians != nullptr && jacobians[0] != nullptr) {
    Eigen::Map<Eigen::Matrix<double, 10, 10, Eigen::RowMajor>> d(jacobians[0]);
    d = J;
  }
  return r.allFinite();
}

}  // namespace armcal

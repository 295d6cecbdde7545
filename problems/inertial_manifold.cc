#include "problems/inertial_manifold.h"

#include <ceres/jet.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "problems/inertial_coordinates.h"

namespace armcal {
namespace {

constexpr int kEntries[10][2] = {{0, 0}, {1, 1}, {2, 2}, {3, 3}, {0, 1},
                                 {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}};
constexpr double kLeast = 0.01;

// C K with K K' = 1 + D, both upper triangular: one step of the solver. K is
// found by Cholesky from the last column up, as upper triangular factors want
// it, and the coordinates are read off the product C K. So the step is straight
// in the pseudo-inertia, (C K) (C K)' = C (1 + D) C', though it is taken in the
// logarithms.
//
// A pivot x below kLeast would be a body with no extent left in a direction. It
// continues as kLeast^2 / (2 kLeast - x), which meets x at kLeast with the same
// value and slope and stays above 0 for any x, so that the derivative that the
// solver has is that of the step.
template <class T>
void Step(const double* c, const T* D, T* result) {
  using std::log;
  using std::sqrt;
  Eigen::Matrix<T, 4, 4> K = Eigen::Matrix<T, 4, 4>::Identity();
  for (int k = 0; k < 10; ++k) K(kEntries[k][0], kEntries[k][1]) += D[k];
  for (int j = 3; j >= 0; --j) {
    for (int k = j + 1; k < 4; ++k) K(j, j) -= K(j, k) * K(j, k);
    if (K(j, j) < T(kLeast)) {
      K(j, j) = T(kLeast * kLeast) / (T(2 * kLeast) - K(j, j));
    }
    K(j, j) = sqrt(K(j, j));
    for (int i = 0; i < j; ++i) {
      for (int k = j + 1; k < 4; ++k) K(i, j) -= K(i, k) * K(j, k);
      K(i, j) /= K(j, j);
    }
  }
  const Eigen::Matrix<T, 4, 4> U =
      LogCholeskyFactor(c).cast<T>().template triangularView<Eigen::Upper>() *
      K;
  result[0] = T(c[0]) + log(K(3, 3));
  for (int i = 0; i < 3; ++i) {
    result[1 + i] = log(U(i, i) / U(3, 3));
    result[7 + i] = U(i, 3) / U(3, 3);
  }
  result[4] = U(0, 1) / U(3, 3);
  result[5] = U(1, 2) / U(3, 3);
  result[6] = U(0, 2) / U(3, 3);
}

}  // namespace

bool InertialManifold::Plus(const double* x, const double* delta,
                            double* x_plus_delta) const {
  Step(x, delta, x_plus_delta);
  return true;
}

// d Plus / d D at D = 0, by forward differentiation of the step itself (Ceres'
// jets), so that both cannot disagree.
bool InertialManifold::PlusJacobian(const double* x, double* jacobian) const {
  using Jet10 = ceres::Jet<double, 10>;
  Jet10 D[10], c[10];
  for (int k = 0; k < 10; ++k) D[k] = Jet10(0, k);
  Step(x, D, c);
  for (int k = 0; k < 10; ++k) {
    Eigen::Map<Vector10d>(jacobian + 10 * k) = c[k].v;
  }
  return true;
}

// The D that leads from x to y: with pseudo-inertias C_x C_x' and C_y C_y',
//   K = C_x^-1 C_y,  D = K K' - 1.
// K is e^(a_y - a_x) U_x^-1 U_y, a triangular solve.
bool InertialManifold::Minus(const double* y, const double* x,
                             double* y_minus_x) const {
  const Eigen::Matrix4d C = LogCholeskyFactor(x);
  const Eigen::Matrix4d K =
      std::exp(y[0] - x[0]) *
      C.triangularView<Eigen::Upper>().solve(LogCholeskyFactor(y));
  const Eigen::Matrix4d D = K * K.transpose() - Eigen::Matrix4d::Identity();
  for (int k = 0; k < 10; ++k) {
    y_minus_x[k] = D(kEntries[k][0], kEntries[k][1]);
  }
  return true;
}

// Near x Minus undoes Plus, so that its derivative is the inverse of Plus'.
bool InertialManifold::MinusJacobian(const double* x, double* jacobian) const {
  using Matrix10d = Eigen::Matrix<double, 10, 10, Eigen::RowMajor>;
  Matrix10d plus;
  PlusJacobian(x, plus.data());
  const Matrix10d inverse = plus.inverse();
  std::copy(inverse.data(), inverse.data() + 100, jacobian);
  return true;
}

}  // namespace armcal

#include "problems/inertial_coordinates.h"

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>

namespace armcal {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

// Upper triangular U with U U' = F'F. Not by way of F'F, whose rounding hides
// what is thin.
Matrix3d UpperCholesky(const Matrix3d& F) {
  const Eigen::HouseholderQR<Matrix3d> qr(F.rowwise().reverse().eval());
  Matrix3d R = qr.matrixQR().triangularView<Eigen::Upper>();
  for (int k = 0; k < 3; ++k) {
    if (R(k, k) < 0) R.row(k) *= -1;
  }
  return R.transpose().rowwise().reverse().colwise().reverse();
}

}  // namespace

Vector10d LogCholeskyFromInertial(const Vector10d& V, double margin,
                                  double least_mass) {
  const double mass = std::max(V[0], least_mass);
  const Vector3d com =
      V[0] > 0 ? Vector3d(V.segment<3>(1) / V[0]) : Vector3d(Vector3d::Zero());
  const Matrix3d moments = PseudoInertia(V).topLeftCorner<3, 3>() / mass;
  Eigen::SelfAdjointEigenSolver<Matrix3d> eigen(moments - (V[0] / mass) * com *
                                                              com.transpose());
  // m^2, below which rounding decides whether a body can be.
  const double rounding = std::max(1e-17 * moments.trace(), 1e-60);
  const double least = std::max(margin * margin, rounding);
  const Vector3d values = eigen.eigenvalues().cwiseMax(least);
  const Matrix3d U = UpperCholesky(values.cwiseSqrt().asDiagonal() *
                                   Matrix3d(eigen.eigenvectors().transpose()));
  // None is less than the root of the least eigenvalue, but for rounding.
  const Vector3d size = U.diagonal().cwiseMax(std::sqrt(least));
  Vector10d c;
  c << 0.5 * std::log(mass), size.array().log().matrix(), U(0, 1), U(1, 2),
      U(0, 2), com;
  return c;
}

}  // namespace armcal

#include "problems/inertial_coordinates.h"

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>

namespace armcal {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

// Upper triangular U with U U' = F'F, from QR of F with its columns reversed: J
// being the matrix that reverses, F J = Q R gives F'F = (J R' J) (J R' J)', and
// J R' J is upper triangular. F'F is not formed: it has the squares of F's
// singular values, and a body thinner than 1e-8 of its length would be rounded
// to a flat one.
Matrix3d UpperCholesky(const Matrix3d& F) {
  const Eigen::HouseholderQR<Matrix3d> qr(F.rowwise().reverse().eval());
  Matrix3d R = qr.matrixQR().triangularView<Eigen::Upper>();
  for (int k = 0; k < 3; ++k) {
    if (R(k, k) < 0) R.row(k) *= -1;
  }
  return R.transpose().rowwise().reverse().colwise().reverse();
}

}  // namespace

// With c the centre of mass and S the second moments about the origin per mass,
// the pseudo-inertia is m [S c; c' 1]. Its Schur complement S - c c' holds the
// central second moments, which a body must have positive (Wensing, Kim &
// Slotine 2018; Traversaro et al. 2016). Eigenvalues that are not are raised
// there and not in the pseudo-inertia, so that mass and centre of mass stay
// what they are. U of the rest and c are the coordinates.
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

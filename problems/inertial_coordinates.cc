#include "problems/inertial_coordinates.h"

#include <Eigen/Eigenvalues>
#include <algorithm>

namespace armcal {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

// Upper triangular U with U U' = S, for S positive definite.
Matrix3d UpperCholesky(const Matrix3d& S) {
  const Matrix3d flipped = S.rowwise().reverse().colwise().reverse();
  const Matrix3d L = flipped.llt().matrixL();
  return L.rowwise().reverse().colwise().reverse();
}

}  // namespace

Vector10d LogCholeskyFromInertial(const Vector10d& V, double margin,
                                  double least_mass) {
  const double mass = std::max(V[0], least_mass);
  const Vector3d com =
      V[0] > 0 ? Vector3d(V.segment<3>(1) / V[0]) : Vector3d(Vector3d::Zero());
  const Matrix3d central = PseudoInertia(V).topLeftCorner<3, 3>() / mass -
                           (V[0] / mass) * com * com.transpose();
  Eigen::SelfAdjointEigenSolver<Matrix3d> eigen(central);
  const Vector3d values = eigen.eigenvalues().cwiseMax(margin * margin);
  const Matrix3d U = UpperCholesky(eigen.eigenvectors() * values.asDiagonal() *
                                   eigen.eigenvectors().transpose());
  Vector10d c;
  c << 0.5 * std::log(mass), std::log(U(0, 0)), std::log(U(1, 1)),
      std::log(U(2, 2)), U(0, 1), U(1, 2), U(0, 2), com;
  return c;
}

}  // namespace armcal

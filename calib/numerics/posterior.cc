#include "calib/numerics/posterior.h"

#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <algorithm>

#include "calib/numerics/singular_values.h"
#include "model/signals/dense_solvers.h"

namespace armcal {

using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

// The factor of P, whose diagonal is 1. A body that hardly exists (a thin rod)
// has a prior that is positive definite but for rounding, which is added.
Eigen::LLT<MatrixXd> Factor(const MatrixXd& P) {
  const MatrixXd one = MatrixXd::Identity(P.rows(), P.cols());
  Eigen::LLT<MatrixXd> llt(P);
  for (double rounding = 1e-15; llt.info() != Eigen::Success && rounding < 1;
       rounding *= 10) {
    llt.compute(P + rounding * one);
  }
  return llt;
}

}  // namespace

Posterior::Posterior(const MatrixXd& A, const MatrixXd& prior,
                     const std::vector<int>& kept) {
  constexpr double kFlat = 1e-20;  // a wider one would lose digits of the SVD
  MatrixXd P = prior(kept, kept);
  const Eigen::Index p = P.rows();
  MatrixXd relative = MatrixXd::Zero(std::max(A.rows(), p), p);
  relative.topRows(A.rows()) = A(Eigen::all, kept);
  for (Eigen::Index k = 0; k < p; ++k) {
    if (P(k, k) > 0) continue;
    P(k, k) = std::max(kFlat * relative.col(k).squaredNorm(), 1e-300);
  }
  // P = S^-1 L L' S^-1 with S for the units.
  const VectorXd s = P.diagonal().cwiseSqrt().cwiseInverse();
  const Eigen::LLT<MatrixXd> llt = Factor(s.asDiagonal() * P * s.asDiagonal());
  relative = relative * s.asDiagonal();
  relative = llt.matrixL().solve(relative.transpose()).transpose().eval();
  const Eigen::HouseholderQR<MatrixXd> qr(relative);
  const MatrixXd R = qr.matrixQR().topRows(p).triangularView<Eigen::Upper>();
  const SingularValues svd = DecomposeSingular(R);
  // solveInPlace writes to what it takes as const.
  // NOLINTNEXTLINE(performance-unnecessary-copy-initialization)
  MatrixXd T = svd.V;
  llt.matrixU().solveInPlace(T);
  T_ = MatrixXd::Zero(A.cols(), p);
  T_(kept, Eigen::all) = s.asDiagonal() * T;
  shrink_ = (1 + svd.s.array().square()).inverse();
}

MatrixXd Posterior::Gain() const {
  return T_ * shrink_.asDiagonal() * T_.transpose();
}

MatrixXd Posterior::Sandwich(const MatrixXd& F) const {
  const MatrixXd root = F * T_ * shrink_.asDiagonal() * T_.transpose();
  return root.transpose() * root;
}

MatrixXd SquareRoot(const MatrixXd& A) {
  const VectorXd s = A.diagonal().cwiseMax(1e-300).cwiseSqrt();
  const auto unscale = s.cwiseInverse().asDiagonal();
  const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(
      MatrixXd(unscale * A * unscale));
  return eigen.eigenvalues().cwiseMax(0).cwiseSqrt().asDiagonal() *
         eigen.eigenvectors().transpose() * s.asDiagonal();
}

MatrixXd Sandwich(const MatrixXd& G, const MatrixXd& A) {
  const MatrixXd root = SquareRoot(A) * G.transpose();
  return root.transpose() * root;
}

}  // namespace armcal

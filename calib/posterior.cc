#include "calib/posterior.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>

namespace armcal {

using Eigen::MatrixXd;
using Eigen::VectorXd;

Posterior::Posterior(const MatrixXd& data, const MatrixXd& prior,
                     const std::vector<int>& kept) {
  constexpr double kFlat = 1e-8;
  MatrixXd P = prior(kept, kept);
  const MatrixXd H = data(kept, kept);
  for (Eigen::Index k = 0; k < P.rows(); ++k) {
    if (P(k, k) == 0) P(k, k) = std::max(kFlat * H(k, k), 1e-300);
  }
  // P = S^-1 L L' S^-1 with S for the units.
  const VectorXd s = P.diagonal().cwiseSqrt().cwiseInverse();
  const Eigen::LLT<MatrixXd> llt(MatrixXd(s.asDiagonal() * P * s.asDiagonal()));
  MatrixXd relative = s.asDiagonal() * H * s.asDiagonal();
  llt.matrixL().solveInPlace(relative);
  relative = llt.matrixL().solve(relative.transpose()).eval();
  const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(relative);
  MatrixXd T = eigen.eigenvectors();
  llt.matrixU().solveInPlace(T);
  T_ = MatrixXd::Zero(data.rows(), P.cols());
  T_(kept, Eigen::all) = s.asDiagonal() * T;
  shrink_ = (1 + eigen.eigenvalues().array().max(0)).inverse();
}

MatrixXd Posterior::Gain() const {
  return T_ * shrink_.asDiagonal() * T_.transpose();
}

MatrixXd Posterior::Sandwich(const MatrixXd& scores) const {
  MatrixXd inner = T_.transpose() * scores * T_;
  inner = shrink_.asDiagonal() * inner * shrink_.asDiagonal();
  // Rounding may have left a trace below 0 of what is as good as 0.
  for (double& d : inner.diagonal()) d = std::max(d, 0.0);
  return T_ * inner * T_.transpose();
}

}  // namespace armcal

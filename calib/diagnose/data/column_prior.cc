#include "calib/diagnose/data/column_prior.h"

#include <algorithm>
#include <utility>

#include "model/signals/dense_solvers.h"

namespace armcal {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// With the standard deviations S and the correlation R = V diag(l) V',
//   C = S R S,   U = diag(l^-1/2) V' S^-1.
// Eigenvalues of a correlation are right to some n eps, 2e-14 of 84 parameters
// of an arm of six joints; what is below kLeast is not told from rounding there
// and is a direction known to 1e-5 of its parameters' standard deviations,
// which is far below the discrepancy of any model (discrepancy.h). It counts as
// known to that.
ColumnPrior::ColumnPrior(std::vector<int> which, const MatrixXd& covariance)
    : which_(std::move(which)),
      mean_(VectorXd::Zero(covariance.rows())),
      stddev_(covariance.diagonal().cwiseSqrt()) {
  constexpr double kLeast = 1e-10;
  const auto unscale = stddev_.cwiseInverse().asDiagonal();
  const Eigen::SelfAdjointEigenSolver<MatrixXd> correlation(
      MatrixXd(unscale * covariance * unscale));
  root_ = correlation.eigenvalues()
              .cwiseMax(kLeast)
              .cwiseSqrt()
              .cwiseInverse()
              .asDiagonal() *
          correlation.eigenvectors().transpose() * unscale;
}

MatrixXd ColumnPrior::Precision(int columns) const {
  MatrixXd precision = MatrixXd::Identity(columns, columns);
  precision(which_, which_) = root_.transpose() * root_;
  return precision;
}

VectorXd ColumnPrior::PrecisionTimesMean(int columns) const {
  VectorXd product = VectorXd::Zero(columns);
  product(which_) = root_.transpose() * (root_ * mean_);
  return product;
}

// What values differ from their prior by, in units of its deviations: U (x -
// mean) with U' U the precision, so that its squared norm is chi squared of the
// prior; of columns it does not know of N(0, 1).
VectorXd ColumnPrior::Residual(const VectorXd& x) const {
  VectorXd residual = x;
  residual(which_) = root_ * (x(which_) - mean_);
  return residual;
}

double ColumnPrior::Stddev(int column) const {
  const auto at = std::lower_bound(which_.begin(), which_.end(), column);
  if (at == which_.end() || *at != column) return 1;
  return stddev_[at - which_.begin()];
}

}  // namespace armcal

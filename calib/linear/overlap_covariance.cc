#include "calib/linear/overlap_covariance.h"

#include <algorithm>
#include <cmath>

#include "model/simd/kernels.h"

namespace armcal {

using Eigen::ArrayXd;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr int kTogether = 64;  // rows whose products are summed in one go

}  // namespace

double InformingSlope(const LossAt& loss) { return std::max(loss.slope, .01); }

OverlapCovariance::OverlapCovariance(int num_joints, int num_parameters,
                                     int rows_per_window)
    : lags_(rows_per_window),
      distances_(2 * lags_ - 1),
      rows_(VectorXd::Zero(num_joints)),
      products_(MatrixXd::Zero(num_joints, lags_)) {
  const MatrixXd zero = MatrixXd::Zero(num_parameters, num_parameters);
  squares_.assign(num_joints * distances_, {zero, zero, zero});
  const int room = num_old() + kTogether;
  recent_.U.assign(num_joints, MatrixXd::Zero(room, num_parameters));
  recent_.r = recent_.slope = recent_.used = MatrixXd::Zero(room, num_joints);
  recent_.num_before.assign(room, 0);
}

void OverlapCovariance::Break() { follows_ = false; }

// Autocovariances c_l of a joint's errors begin as sums of r(t) r(t - l) over
// rows that both count and follow each other without a gap.
void OverlapCovariance::Add(const FittedRow& row) {
  if (recent_.added == kTogether) SumProducts();
  const int k = num_old() + recent_.added++;
  std::vector<int>& num_before = recent_.num_before;
  num_before[k] =
      follows_ && k > 0 ? std::min(num_before[k - 1] + 1, num_old()) : 0;
  follows_ = true;
  recent_.r.row(k) = row.r;
  recent_.slope.row(k) = row.slope;
  for (int i = 0; i < row.r.size(); ++i) {
    recent_.U[i].row(k) = row.U.row(i);
    recent_.used(k, i) = row.used[i] ? 1 : 0;
    if (!row.used[i]) continue;
    rows_[i] += 1;
    for (int d = 0; d <= std::min(num_before[k], lags_ - 1); ++d) {
      products_(i, d) += recent_.r(k, i) * recent_.r(k - d, i);
    }
  }
}

void OverlapCovariance::SumProducts() {
  const int added = recent_.added, old = num_old();
  if (added == 0) return;
  for (size_t i = 0; i < recent_.U.size(); ++i) {
    AddSquares(static_cast<int>(i));
  }
  const auto move = [&](MatrixXd* rows) {
    rows->topRows(old) = rows->middleRows(added, old).eval();
  };
  for (MatrixXd& U : recent_.U) move(&U);
  for (MatrixXd* x : {&recent_.r, &recent_.slope, &recent_.used}) move(x);
  std::vector<int>& num_before = recent_.num_before;
  std::copy_n(num_before.begin() + added, old, num_before.begin());
  recent_.added = 0;
}

// Adds sums of u(t)' u(t - d), for one joint, of the new rows with the rows a
// distance d before them, as they are and times the slopes. Sixty-four rows are
// taken together: a product of matrices instead of as many outer products,
// which would go through the whole sum each time.
void OverlapCovariance::AddSquares(int joint) {
  const int added = recent_.added, old = num_old();
  const auto U = recent_.U[joint].topRows(old + added);
  std::vector<int> columns;  // others are 0
  for (int c = 0; c < U.cols(); ++c) {
    if ((U.col(c).array() != 0).any()) columns.push_back(c);
  }
  const int size = static_cast<int>(columns.size());
  if (size == 0) return;
  MatrixXd before = MatrixXd::Zero(old + kTogether, size);
  before.topRows(old + added) = U(Eigen::all, columns);
  MatrixXd now = MatrixXd::Zero(kTogether, 3 * size);
  MatrixXd products(3 * size, size);
  const auto slope = recent_.slope.col(joint).segment(old, added).array();
  for (int d = 0; d < distances_; ++d) {
    ArrayXd any = recent_.used.col(joint).segment(old, added);
    for (int k = 0; k < added; ++k) {
      if (recent_.num_before[old + k] < d) any[k] = 0;
    }
    const auto other = recent_.slope.col(joint).segment(old - d, added).array();
    const ArrayXd weights[] = {any * (.5 * (slope + other)), any,
                               any * slope * other};
    const int parts = d < lags_ ? 3 : 1;
    for (int c = 0; c < parts * size; ++c) {
      now.col(c).head(added) =
          weights[c / size] * before.col(c % size).segment(old, added).array();
    }
    simd::BestKernels().inner_products(
        now.data(), kTogether, parts * size, before.data() + old - d,
        old + kTogether, size, (added + 7) / 8 * 8, products.data());
    Squares& squares = squares_[joint * distances_ + d];
    MatrixXd* const to[] = {&squares.mean, &squares.all, &squares.both};
    for (int c = 0; c < size; ++c) {
      const double* from = products.data() + c * parts * size;
      for (int part = 0; part < parts; ++part) {
        double* const column = to[part]->col(columns[c]).data();
        for (int a = 0; a < size; ++a) column[columns[a]] += *from++;
      }
    }
  }
}

// How much smaller products_ are for the fit. The hat matrix is H = scale^2 U G
// U', whose rows the loss's slopes scale, and W the errors' covariance.
// Residuals have
//   (1 - H) W (1 - H)' = W - (H W + W H' - H W H').
// Summed over pairs of rows that are l apart,
//   H W + W H' -> 2 sum_k c_|k| h_|l+k|,
//   H W H'     -> scale^2 <cov, sum_t u(t)' u(t - l)>,
// where h_d is the sum of H's entries of rows d apart and cov the covariance of
// x.
MatrixXd OverlapCovariance::Taken(const MatrixXd& gain, const VectorXd& scale,
                                  const MatrixXd& c,
                                  const MatrixXd& covariance) const {
  MatrixXd taken = MatrixXd::Zero(c.rows(), lags_);
  for (int i = 0; i < scale.size(); ++i) {
    if (rows_[i] == 0) continue;
    const double square = scale[i] * scale[i];
    VectorXd hat(distances_);
    for (int d = 0; d < distances_; ++d) {
      hat[d] = square * gain.cwiseProduct(Square(i, d).mean).sum();
    }
    for (int l = 0; l < lags_; ++l) {
      for (int k = 1 - lags_; k < lags_; ++k) {
        taken(i, l) += 2 * c(i, std::abs(k)) * hat[std::abs(l + k)];
      }
      taken(i, l) -= square * covariance.cwiseProduct(Square(i, l).both).sum();
    }
  }
  return taken;
}

// The covariance of x is
//   G [sum_i scale_i^2 sum_|l| c_il S_il] G',   S_il = sum_t u(t)' u(t - l),
// with autocovariances c that are zero beyond the overlap (Hansen & Hodrick
// 1980, J. Political Economy 88). c is a fixed point, of ten rounds: what the
// fit has taken from the residuals depends on c and on the covariance, and is
// given back.
MatrixXd OverlapCovariance::Value(const MatrixXd& gain, const VectorXd& scale) {
  SumProducts();
  const auto count = rows_.cwiseMax(1).cwiseInverse().asDiagonal();
  MatrixXd c = count * products_, covariance;
  for (int iteration = 0; iteration < 10; ++iteration) {
    MatrixXd sum = MatrixXd::Zero(gain.rows(), gain.cols());
    for (int i = 0; i < scale.size(); ++i) {
      const double square = scale[i] * scale[i];
      sum += square * c(i, 0) * Square(i, 0).all;
      for (int l = 1; l < lags_; ++l) {
        const MatrixXd& all = Square(i, l).all;
        sum += square * c(i, l) * (all + all.transpose());
      }
    }
    covariance = gain * sum * gain.transpose();
    c = count * (products_ + Taken(gain, scale, c, covariance));
    // Where parameters take most of a joint's rows nothing can be given back.
    for (int i = 0; i < scale.size(); ++i) {
      const double left = products_(i, 0) / std::max(1., rows_[i]);
      if (c(i, 0) > 4 * left) c.row(i) *= 4 * left / c(i, 0);
      // What is given back adds to the variance, and none at a lag is larger:
      // else the iteration may run away.
      const double variance = std::max(left, c(i, 0));
      c.row(i) = c.row(i).cwiseMax(-variance).cwiseMin(variance);
      c(i, 0) = variance;
    }
  }
  return covariance;
}

// D C D with D >= 1 diagonal: deviations grow, correlations stay, and C remains
// positive semidefinite.
MatrixXd RaiseTo(const VectorXd& least, const MatrixXd& covariance) {
  VectorXd factor(covariance.rows());
  for (Eigen::Index k = 0; k < factor.size(); ++k) {
    const double ratio = least[k] / covariance(k, k);
    factor[k] = covariance(k, k) > 0 ? std::sqrt(std::max(1.0, ratio)) : 1;
  }
  return factor.asDiagonal() * covariance * factor.asDiagonal();
}

}  // namespace armcal

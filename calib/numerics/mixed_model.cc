#include "calib/numerics/mixed_model.h"

#include <tbb/parallel_for.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace armcal {

using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

// The pseudo-inverse of an information matrix, and which share of each entry
// it sees.
void Invert(const MatrixXd& H, MatrixXd* inverse, VectorXd* determined) {
  constexpr double kLeast = 1e-10;  // of the best seen direction
  const VectorXd size = H.diagonal().cwiseMax(1e-300).cwiseSqrt();
  const MatrixXd scaled =
      size.cwiseInverse().asDiagonal() * H * size.cwiseInverse().asDiagonal();
  const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(scaled);
  const VectorXd& values = eigen.eigenvalues();
  const MatrixXd& vectors = eigen.eigenvectors();
  *inverse = MatrixXd::Zero(H.rows(), H.cols());
  *determined = VectorXd::Zero(H.rows());
  for (Eigen::Index k = 0; k < values.size(); ++k) {
    if (values[k] <= kLeast * values[values.size() - 1]) continue;
    const VectorXd v = vectors.col(k).cwiseQuotient(size);
    *inverse += v * v.transpose() / values[k];
    *determined += vectors.col(k).cwiseAbs2();
  }
}

}  // namespace

MixedModel::MixedModel(const std::vector<UnitEvidence>& evidence, int units,
                       bool drift)
    : drift_(drift), units_(units) {
  const Eigen::Index m = evidence.at(0).right.size();
  VectorXd total = VectorXd::Zero(m);
  double first = evidence[0].time, last = first;
  for (const UnitEvidence& e : evidence) {
    total += e.information.diagonal();
    reference_ += e.time / static_cast<double>(evidence.size());
    first = std::min(first, e.time), last = std::max(last, e.time);
  }
  if (last > first) time_scale_ = last - first;
  drift_ = drift_ && last > first;
  const double mean = 1. / units;
  scale_ = (mean * total).cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
  for (Eigen::Index k = 0; k < m; ++k) {
    if (total[k] <= 0) scale_[k] = 1;
  }
  const Eigen::Index p = drift_ ? 2 * m : m;
  for (Unit& unit : units_) {
    unit = {MatrixXd::Zero(m, m), MatrixXd::Zero(p, m), MatrixXd::Zero(p, p),
            VectorXd::Zero(m),    VectorXd::Zero(p),    -1e300};
  }
  for (const UnitEvidence& e : evidence) {
    Unit& unit = units_[e.unit];
    const double t = (e.time - reference_) / time_scale_;
    const MatrixXd L =
        scale_.asDiagonal() * e.information * scale_.asDiagonal();
    const VectorXd right = scale_.cwiseProduct(e.right);
    const auto power = [t](Eigen::Index k) {
      return k == 0 ? 1 : k == 1 ? t : t * t;
    };
    for (Eigen::Index a = 0; a < p / m; ++a) {
      unit.B.middleRows(a * m, m) += power(a) * L;
      unit.fixed_right.segment(a * m, m) += power(a) * right;
      for (Eigen::Index b = 0; b < p / m; ++b) {
        unit.A.block(a * m, b * m, m, m) += power(a + b) * L;
      }
    }
    unit.L += L;
    unit.right += right;
    unit.last = std::max(unit.last, t);
  }
  root_ = VectorXd::Ones(m);
}

// (L + T^-1)^-1, also where T has zeros.
MatrixXd MixedModel::Posterior(int u, const VectorXd& root) const {
  const MatrixXd one = MatrixXd::Identity(root.size(), root.size());
  const MatrixXd inner =
      one + root.asDiagonal() * units_[u].L * root.asDiagonal();
  return root.asDiagonal() * inner.llt().solve(one) * root.asDiagonal();
}

// A unit's part of the normal equations is threads' work; parts are summed in
// the order of the units, so that the sum does not depend on who made them.
void MixedModel::SolveFixed(const std::vector<bool>& left_out) {
  posteriors_.resize(units_.size());
  std::vector<MatrixXd> H(units_.size());
  std::vector<VectorXd> right(units_.size());
  tbb::parallel_for(0, size(), [&](int u) {
    const Unit& unit = units_[u];
    posteriors_[u] = Posterior(u, root_);
    if (left_out[u]) return;
    const MatrixXd BV = unit.B * posteriors_[u];
    H[u] = unit.A - BV * unit.B.transpose();
    right[u] = unit.fixed_right - BV * unit.right;
  });
  const Eigen::Index p = units_[0].A.rows();
  MatrixXd all_H = MatrixXd::Zero(p, p);
  VectorXd all_right = VectorXd::Zero(p);
  for (size_t u = 0; u < units_.size(); ++u) {
    if (left_out[u]) continue;
    all_H += H[u];
    all_right += right[u];
  }
  Invert(all_H, &covariance_, &determined_);
  fixed_ = covariance_ * all_right;
}

// One step of the fixed point; the largest change of log T.
double MixedModel::UpdateSpread(const std::vector<bool>& left_out) {
  constexpr double kNone = 1e-4;  // of what one unit's data tell apart
  const Eigen::Index m = root_.size();
  // A column per unit; 0 of those left out.
  MatrixXd square = MatrixXd::Zero(m, size()), free = square;
  tbb::parallel_for(0, size(), [&](int u) {
    if (left_out[u]) return;
    const Unit& unit = units_[u];
    const MatrixXd& V = posteriors_[u];
    const MatrixXd G = V * unit.B.transpose();
    const VectorXd d = V * unit.right - G * fixed_;
    const VectorXd variance =
        V.diagonal() + (G * covariance_).cwiseProduct(G).rowwise().sum();
    square.col(u) = d.cwiseAbs2();
    free.col(u) = VectorXd::Ones(m) -
                  variance.cwiseQuotient(root_.cwiseAbs2().cwiseMax(1e-300));
  });
  VectorXd squares = VectorXd::Zero(m), freedom = VectorXd::Zero(m);
  for (int u = 0; u < size(); ++u) {
    squares += square.col(u);
    freedom += free.col(u);
  }
  double change = 0;
  for (Eigen::Index k = 0; k < m; ++k) {
    if (root_[k] == 0) continue;
    const double before = root_[k] * root_[k];
    double now = squares[k] / std::max(freedom[k], 1e-3);
    // Far from the fixed point a step overshoots.
    now = std::clamp(now, before / 100, before * 100);
    root_[k] = now < kNone * kNone ? 0 : std::sqrt(now);
    // What is nothing beside the data's noise need not settle.
    const bool matters = root_[k] > .03;
    if (matters) change = std::max(change, std::abs(std::log(now / before)));
  }
  return change;
}

void MixedModel::Fit(const std::vector<bool>& left_out) {
  constexpr int kMost = 60;
  constexpr double kSettled = .01;  // of variances
  root_ = root_.cwiseMax(.1);       // what was none may be some now
  for (int k = 0; k < kMost; ++k) {
    SolveFixed(left_out);
    if (UpdateSpread(left_out) < kSettled) break;
  }
  SolveFixed(left_out);
}

}  // namespace armcal

#include "calib/diagnose/select/drop.h"

#include <Eigen/Cholesky>
#include <vector>

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// Of what the baseline and the chosen leave of a column, less than this share
// is rounding and errors of form.
constexpr double kVisibleShare = 1e-6;

bool IsPositive(const GapCandidate& candidate, int k) {
  return candidate.effect->parameters[candidate.linear[k]].sign ==
         EffectParameter::Sign::kPositive;
}

// Zero for columns that are not used.
VectorXd Coefficients(const MatrixXd& G, const VectorXd& g,
                      const std::vector<bool>& used) {
  MatrixXd equations = MatrixXd::Identity(G.rows(), G.cols());
  VectorXd right = VectorXd::Zero(g.size());
  for (int k = 0; k < g.size(); ++k) {
    if (!used[k]) continue;
    right[k] = g[k];
    for (int l = 0; l < g.size(); ++l) {
      if (used[l]) equations(k, l) = G(k, l);
    }
  }
  return equations.llt().solve(right);
}

}  // namespace

DropsBeside::DropsBeside(const GapScreen& screen,
                         const std::vector<GapCandidate>& candidates,
                         const std::vector<int>& S)
    : screen_(screen), candidates_(candidates), S_(S) {
  const int size = static_cast<int>(S.size());
  if (size > 0) {
    MatrixXd G(size, size), cross(size, screen.size());
    for (int k = 0; k < size; ++k) {
      cross.row(k) = screen.G().row(S[k]);
      for (int l = 0; l < size; ++l) G(k, l) = screen.G()(S[k], S[l]);
      G(k, k) += screen.ridge(S[k]);
    }
    factor_.compute(G);
    half_ = factor_.matrixL().solve(cross);
  }
  for (const GapCandidate& candidate : candidates) {
    own_.push_back(OwnOf(candidate));
  }
}

DropsBeside::Own DropsBeside::OwnOf(const GapCandidate& candidate) const {
  const int size = static_cast<int>(candidate.columns.size());
  Own own{MatrixXd(size, size), std::vector<bool>(size)};
  for (int k = 0; k < size; ++k) {
    const int a = candidate.columns[k];
    for (int l = 0; l < size; ++l) {
      const int b = candidate.columns[l];
      own.G(k, l) = screen_.G()(a, b);
      if (half_.size() > 0) own.G(k, l) -= half_.col(a).dot(half_.col(b));
    }
    own.used[k] = own.G(k, k) > kVisibleShare * screen_.raw(a);
    own.G(k, k) += screen_.ridge(a);
  }
  return own;
}

VectorXd DropsBeside::Conditioned(const VectorXd& gradient) const {
  if (S_.empty()) return gradient;
  const VectorXd g = gradient(S_);
  return gradient - half_.transpose() * factor_.matrixL().solve(g);
}

double DropsBeside::Of(size_t i, const VectorXd& conditioned) const {
  const GapCandidate& candidate = candidates_[i];
  const Own& own = own_[i];
  if (candidate.columns.size() == 1) {
    const double g = conditioned[candidate.columns[0]];
    const bool wrong = IsPositive(candidate, 0) && g < 0;
    return !own.used[0] || wrong ? 0 : g * g / own.G(0, 0);
  }
  const VectorXd g = conditioned(candidate.columns);
  std::vector<bool> used = own.used;
  while (true) {
    const VectorXd x = Coefficients(own.G, g, used);
    int wrong = -1, right = 0;
    for (int k = 0; k < x.size(); ++k) {
      if (!used[k] || !IsPositive(candidate, k)) continue;
      if (x[k] >= 0) {
        ++right;
      } else if (wrong < 0 || x[k] < x[wrong]) {
        wrong = k;
      }
    }
    if (wrong < 0) return g.dot(x);
    if (right == 0) return 0;
    used[wrong] = false;
  }
}

}  // namespace armcal

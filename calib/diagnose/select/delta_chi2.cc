#include "calib/diagnose/select/delta_chi2.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <vector>

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// Of what the baseline and the chosen leave of a column, less than this share
// is rounding and errors of form.
constexpr double kVisibleShare = 1e-6;

// The solution of G x = g over the used columns alone, the normal equations of
// a fit in which the others have the coefficient 0: their rows and columns of G
// are replaced by those of the identity.
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

// What all candidates have in common is computed once. With G the Gram matrix
// of the projected columns and g their products with the residual, adding
// columns A to a set S that is fitted with them lowers chi squared by
//   g_A|S' G_AA|S^-1 g_A|S,
//   G_AA|S = G_AA - G_AS G_SS^-1 G_SA,  g_A|S = g_A - G_AS G_SS^-1 g_S,
// the Schur complements of the partitioned normal equations (Frisch and Waugh
// 1933; Boyd and Vandenberghe 2004, A.5.5). With G_SS = L L' and H = L^-1 G_S.
// the complements are differences of products of H's columns: one triangular
// solve serves every candidate. Ridges of S are those of the screen, by which
// columns that the baseline all but absorbs stay solvable.
DeltaChi2Given::DeltaChi2Given(const GapScreen& screen,
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

// G_AA|S of one candidate. A column of which the baseline and S leave less than
// kVisibleShare of its squared norm is not used: what is left of it is
// rounding, and dividing by it would make chi squared of nothing.
DeltaChi2Given::Own DeltaChi2Given::OwnOf(const GapCandidate& candidate) const {
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

// g - G_.S G_SS^-1 g_S for all columns at once: what a gradient has beyond what
// S explains of it. It is asked for each of the 200 draws of chance (null.cc),
// so that it must not cost a factorisation.
VectorXd DeltaChi2Given::Conditioned(const VectorXd& gradient) const {
  if (S_.empty()) return gradient;
  const VectorXd g = gradient(S_);
  return gradient - half_.transpose() * factor_.matrixL().solve(g);
}

// delta_chi2 = g' G^-1 g = g' x, with coefficients of a known sign kept at that
// sign, or at that of the first. That is a small non-negative least squares
// problem, solved as by Lawson and Hanson (1974, chapter 23) without their way
// back: the coefficient that is the most negative leaves, and the rest is
// fitted again. Candidates have so few columns that one which would have to
// come back is rare, and then delta_chi2 is too small rather than too large.
// Where every coefficient has the wrong sign the law would have to act
// backwards, and explains nothing.
double DeltaChi2Given::Of(size_t i, const VectorXd& conditioned) const {
  const GapCandidate& candidate = candidates_[i];
  const Own& own = own_[i];
  if (candidate.columns.size() == 1) {
    const double g = conditioned[candidate.columns[0]];
    const bool wrong = candidate.IsPositive(candidate.linear[0]) && g < 0;
    if (!own.used[0] || wrong) return 0;
    const double x =
        std::clamp(g / own.G(0, 0), candidate.least, candidate.most);
    return std::max(0., x * (2 * g - own.G(0, 0) * x));
  }
  const VectorXd g = conditioned(candidate.columns);
  std::vector<bool> used = own.used;
  while (true) {
    const VectorXd x = Coefficients(own.G, g, used);
    int wrong = -1, right = 0;
    bool any_positive = false;
    for (int k = 0; k < x.size(); ++k) {
      if (!used[k] || !candidate.IsPositive(candidate.linear[k])) continue;
      any_positive = true;
      if (x[k] >= 0) {
        ++right;
      } else if (wrong < 0 || x[k] < x[wrong]) {
        wrong = k;
      }
    }
    if (any_positive && right == 0) return 0;
    for (int k = 0; k < x.size() && wrong < 0; ++k) {
      if (!used[k] || !candidate.IsAsFirst(candidate.linear[k])) continue;
      const bool is_positive = candidate.IsPositive(candidate.linear[0]);
      if (x[k] * x[0] < 0 || (is_positive && x[k] < 0)) wrong = k;
    }
    if (wrong < 0) return g.dot(x);
    used[wrong] = false;
  }
}

}  // namespace armcal

#include "calib/gap_drop.h"

#include <Eigen/Cholesky>
#include <vector>

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// Of what the baseline and the chosen leave of a column, less than this share
// is rounding and errors of form.
constexpr double kVisible = 1e-6;

bool IsPositive(const GapCandidate& candidate, int k) {
  return candidate.effect->parameters[candidate.linear[k]].sign ==
         EffectParameter::Sign::kPositive;
}

// The candidate's columns beside S, those that are `used`.
struct OwnEquations {
  MatrixXd G;
  VectorXd g;
};

OwnEquations EquationsOf(const GapScreen& screen, const Conditioned& c,
                         const GapCandidate& candidate,
                         std::vector<bool>* used) {
  const int size = static_cast<int>(candidate.columns.size());
  OwnEquations own{MatrixXd::Zero(size, size), VectorXd(size)};
  for (int k = 0; k < size; ++k) {
    const int a = candidate.columns[k];
    for (int l = 0; l < size; ++l) {
      const int b = candidate.columns[l];
      own.G(k, l) = screen.G()(a, b);
      if (c.half.size() > 0) own.G(k, l) -= c.half.col(a).dot(c.half.col(b));
    }
    own.g[k] = c.g[a];
    (*used)[k] = own.G(k, k) > kVisible * screen.raw(a);
    own.G(k, k) += screen.ridge(a);
  }
  return own;
}

// Zero for columns that are not used.
VectorXd Coefficients(const OwnEquations& own, const std::vector<bool>& used) {
  MatrixXd G = MatrixXd::Identity(own.G.rows(), own.G.cols());
  VectorXd g = VectorXd::Zero(own.g.size());
  for (int k = 0; k < g.size(); ++k) {
    if (!used[k]) continue;
    g[k] = own.g[k];
    for (int l = 0; l < g.size(); ++l) {
      if (used[l]) G(k, l) = own.G(k, l);
    }
  }
  return G.llt().solve(g);
}

}  // namespace

Conditioned Condition(const GapScreen& screen, const std::vector<int>& S,
                      const VectorXd& gradient) {
  Conditioned c;
  c.g = gradient;
  if (S.empty()) return c;
  const int size = static_cast<int>(S.size());
  MatrixXd G(size, size), cross(size, screen.size());
  VectorXd g(size);
  for (int k = 0; k < size; ++k) {
    cross.row(k) = screen.G().row(S[k]);
    g[k] = gradient[S[k]];
    for (int l = 0; l < size; ++l) G(k, l) = screen.G()(S[k], S[l]);
    G(k, k) += screen.ridge(S[k]);
  }
  const Eigen::LLT<MatrixXd> factor(G);
  c.half = factor.matrixL().solve(cross);
  c.g -= c.half.transpose() * factor.matrixL().solve(g);
  return c;
}

double Drop(const GapScreen& screen, const Conditioned& c,
            const GapCandidate& candidate) {
  std::vector<bool> used(candidate.columns.size());
  const OwnEquations own = EquationsOf(screen, c, candidate, &used);
  while (true) {
    const VectorXd x = Coefficients(own, used);
    int wrong = -1, right = 0;
    for (int k = 0; k < x.size(); ++k) {
      if (!used[k] || !IsPositive(candidate, k)) continue;
      if (x[k] >= 0) {
        ++right;
      } else if (wrong < 0 || x[k] < x[wrong]) {
        wrong = k;
      }
    }
    if (wrong < 0) return own.g.dot(x);
    if (right == 0) return 0;
    used[wrong] = false;
  }
}

}  // namespace armcal

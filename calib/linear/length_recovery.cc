#include "calib/linear/length_recovery.h"

#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <map>

#include "model/signals/dense_solvers.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// The bilinear model theta = (moments without lengths, joint terms, lengths) ->
// X_full: entry c of X_full is a first moment by itself, or times one of the
// lengths before its joint (docs/theory.md, 1).
class Bilinear {
 public:
  explicit Bilinear(const ModelParameters& parameters)
      : columns_(parameters.moment_columns()),
        num_lengths_(static_cast<int>(parameters.unknown_lengths().size())),
        full_(static_cast<int>(parameters.regrouping().cols())) {
    std::map<std::pair<int, Moment>, int> index;
    for (const MomentColumn& c : columns_) {
      const int next = static_cast<int>(index.size());
      moment_.push_back(
          index.emplace(std::make_pair(c.block, c.moment), next).first->second);
    }
    num_moments_ = static_cast<int>(index.size());
    num_terms_ = full_ - static_cast<int>(columns_.size());
  }

  int size() const { return length_begin() + num_lengths_; }
  int length_begin() const { return num_moments_ + num_terms_; }
  int moment(int column) const { return moment_[column]; }

  VectorXd Value(const VectorXd& theta) const {
    VectorXd x(full_);
    const int m = static_cast<int>(columns_.size());
    for (int c = 0; c < m; ++c) {
      x[c] = theta[moment_[c]] * LengthOf(c, theta);
    }
    x.tail(num_terms_) = theta.segment(num_moments_, num_terms_);
    return x;
  }
  MatrixXd Jacobian(const VectorXd& theta) const {
    MatrixXd J = MatrixXd::Zero(full_, size());
    const int m = static_cast<int>(columns_.size());
    for (int c = 0; c < m; ++c) {
      J(c, moment_[c]) = LengthOf(c, theta);
      if (columns_[c].length >= 0) {
        J(c, length_begin() + columns_[c].length) = theta[moment_[c]];
      }
    }
    J.block(m, num_moments_, num_terms_, num_terms_).setIdentity();
    return J;
  }
  // From any X_full: l = sum (l h) h / sum h^2 over the moments h that are seen
  // with the length l and without it, the least-squares ratio of theory.md. It
  // needs no nominal length.
  VectorXd Start(const VectorXd& x_full) const {
    VectorXd theta = VectorXd::Zero(size());
    const int m = static_cast<int>(columns_.size());
    for (int c = 0; c < m; ++c) {
      if (columns_[c].length < 0) theta[moment_[c]] = x_full[c];
    }
    theta.segment(num_moments_, num_terms_) = x_full.tail(num_terms_);
    VectorXd product = VectorXd::Zero(num_lengths_);
    VectorXd square = VectorXd::Zero(num_lengths_);
    for (int c = 0; c < m; ++c) {
      if (columns_[c].length < 0) continue;
      const double alone = theta[moment_[c]];
      product[columns_[c].length] += alone * x_full[c];
      square[columns_[c].length] += alone * alone;
    }
    for (int l = 0; l < num_lengths_; ++l) {
      theta[length_begin() + l] = square[l] > 0 ? product[l] / square[l] : 0.1;
    }
    return theta;
  }

 private:
  double LengthOf(int c, const VectorXd& theta) const {
    const int l = columns_[c].length;
    return l < 0 ? 1 : theta[length_begin() + l];
  }
  std::vector<MomentColumn> columns_;
  std::vector<int> moment_;
  int num_lengths_, full_, num_moments_, num_terms_;
};

// The usable rows of M and x, whitened by L^-1 of the covariance L L' of
// independent errors, and the covariance L^-1 C L^-T that the whitened x has in
// truth. Correlations instead of covariances are factored, with 1e-10 on the
// diagonal, since parameters of different units and nearly dependent ones would
// otherwise decide by rounding.
struct Whitened {
  Whitened(const MatrixXd& M, const VectorXd& x, const MatrixXd& independent,
           const MatrixXd& covariance, const std::vector<bool>& usable) {
    std::vector<int> rows;
    for (int k = 0; k < x.size(); ++k) {
      if (usable[k] && independent(k, k) > 0) rows.push_back(k);
    }
    const VectorXd s = independent.diagonal()(rows).cwiseSqrt();
    const auto unscale = s.cwiseInverse().asDiagonal();
    MatrixXd correlation = unscale * independent(rows, rows) * unscale;
    correlation.diagonal().array() += 1e-10;
    MatrixXd both(rows.size(), M.cols() + 1);
    both << M(rows, Eigen::all), x(rows);
    both = unscale * both;
    noise = unscale * covariance(rows, rows) * unscale;
    const Eigen::LLT<MatrixXd> llt(correlation);
    llt.matrixL().solveInPlace(both);
    matrix = both.leftCols(M.cols());
    value = both.col(M.cols());
    llt.matrixL().solveInPlace(noise);
    noise = llt.matrixL().solve(noise.transpose()).eval();
  }
  MatrixXd matrix;
  VectorXd value;
  MatrixXd noise;
};

struct Step {
  Eigen::JacobiSVD<MatrixXd> svd;
  VectorXd scale;
};

// The SVD of J with columns of length 1, so that the rank does not hang on
// units.
Step Decompose(const MatrixXd& J) {
  Step step;
  step.scale = J.colwise().norm();
  const double largest = step.scale.maxCoeff();
  for (double& s : step.scale) s = s > 0 ? s : largest > 0 ? largest : 1;
  step.svd.compute(J * step.scale.cwiseInverse().asDiagonal(),
                   Eigen::ComputeThinU | Eigen::ComputeFullV);
  step.svd.setThreshold(1e-9);
  return step;
}

// The share, 0 to 1, of parameter k that lies in the null space of a step,
// which no data tell.
double Unseen(const Step& step, Eigen::Index k) {
  const Eigen::Index beyond = step.svd.matrixV().cols() - step.svd.rank();
  return step.svd.matrixV().row(k).tail(beyond).squaredNorm();
}
constexpr double kUnseenAbove = 1e-8;

// Gauss-Newton with the pseudo-inverse, d = J^+ r, and halved steps. Directions
// that no data tell have no component in J^+ r and stay where they are; J'J
// would be singular.
VectorXd GaussNewton(const Whitened& w, const Bilinear& model, VectorXd theta) {
  double cost = (w.matrix * model.Value(theta) - w.value).squaredNorm();
  for (int iteration = 0; iteration < 100; ++iteration) {
    const Step step = Decompose(w.matrix * model.Jacobian(theta));
    const VectorXd r = w.value - w.matrix * model.Value(theta);
    VectorXd d = step.svd.solve(r).cwiseQuotient(step.scale);
    bool better = false;
    for (int halving = 0; halving < 30 && !better; ++halving, d /= 2) {
      const VectorXd trial = theta + d;
      const double trial_cost =
          (w.matrix * model.Value(trial) - w.value).squaredNorm();
      if (trial_cost >= cost) continue;
      better = cost - trial_cost > 1e-14 * cost;
      theta = trial;
      cost = trial_cost;
    }
    if (!better) break;
  }
  return theta;
}

VectorXd Solve(const Whitened& w, const Bilinear& model) {
  const VectorXd x_full =
      w.matrix.completeOrthogonalDecomposition().solve(w.value);
  return GaussNewton(w, model, model.Start(x_full));
}

VectorXd Nominal(const ModelParameters& parameters) {
  const std::vector<Length>& lengths = parameters.unknown_lengths();
  VectorXd nominal(lengths.size());
  for (size_t l = 0; l < lengths.size(); ++l) {
    nominal[static_cast<int>(l)] = lengths[l].value;
  }
  return nominal;
}

// The change of theta, N a with N the null space of a step, that no data tell
// to first order and that takes its unseen lengths nearest to `nominal`;
// nothing where all lengths are seen.
VectorXd UnseenChange(const Step& step, const VectorXd& theta,
                      const VectorXd& nominal) {
  const Eigen::Index begin = theta.size() - nominal.size();
  std::vector<Eigen::Index> unseen;
  for (Eigen::Index k = begin; k < theta.size(); ++k) {
    if (Unseen(step, k) >= kUnseenAbove) unseen.push_back(k);
  }
  if (unseen.empty()) return VectorXd::Zero(theta.size());
  const MatrixXd N =
      step.scale.cwiseInverse().asDiagonal() *
      step.svd.matrixV().rightCols(theta.size() - step.svd.rank());
  VectorXd wished = theta;
  wished.tail(nominal.size()) = nominal;
  Eigen::CompleteOrthogonalDecomposition<MatrixXd> lengths;
  lengths.setThreshold(1e-9);
  lengths.compute(N(unseen, Eigen::all));
  return N * lengths.solve((wished - theta)(unseen));
}

// The lengths nearest to `nominal` of all that fit as well as those of `theta`:
// data may tell a sum of lengths and none of them. It alternates between a step
// along the null space towards `nominal` and Gauss-Newton back onto the fit, as
// the set of fits is curved. Lengths that are free become nominal.
VectorXd NearestLengths(const Whitened& w, const Bilinear& model,
                        const VectorXd& nominal, const VectorXd& theta) {
  constexpr double kSame = 1e-9;  // m
  const auto cost = [&](const VectorXd& at) {
    return (w.matrix * model.Value(at) - w.value).squaredNorm();
  };
  VectorXd near = theta;
  double moved = 1;
  for (int iteration = 0; iteration < 50 && moved > kSame / 10; ++iteration) {
    const VectorXd d =
        UnseenChange(Decompose(w.matrix * model.Jacobian(near)), near, nominal);
    moved = d.tail(nominal.size()).norm();
    if (moved > 0) near = GaussNewton(w, model, near + d);
  }
  const bool fits =
      cost(near) <= cost(theta) + 1e-6 * (1 + 1e-6 * w.value.squaredNorm());
  if (!fits || !(moved <= kSame)) return nominal;
  VectorXd lengths = near.tail(nominal.size());
  for (Eigen::Index l = 0; l < lengths.size(); ++l) {
    if (std::abs(lengths[l] - nominal[l]) < kSame) lengths[l] = nominal[l];
  }
  return lengths;
}

}  // namespace

// The deviations are of theta = J^+ x with x's true covariance, not (J'J)^-1:
// the sandwich that the header speaks of.
std::vector<RecoveredLength> RecoverLengths(const ModelParameters& parameters,
                                            const VectorXd& x,
                                            const MatrixXd& independent,
                                            const MatrixXd& covariance,
                                            const std::vector<bool>& usable) {
  std::vector<RecoveredLength> result;
  if (parameters.unknown_lengths().empty()) return result;
  const Bilinear model(parameters);
  const Whitened w(parameters.regrouping(), x, independent, covariance, usable);
  if (w.value.size() == 0) {  // Eigen's SVD takes no matrix without rows
    for (const Length& length : parameters.unknown_lengths()) {
      result.push_back({length.owner_name, length.name, length.value,
                        length.value, std::nan(""), false});
    }
    return result;
  }
  const VectorXd theta = Solve(w, model);
  const VectorXd near = NearestLengths(w, model, Nominal(parameters), theta);
  const Step step = Decompose(w.matrix * model.Jacobian(theta));
  const Eigen::Index rank = step.svd.rank();
  const VectorXd& s = step.svd.singularValues();
  for (size_t l = 0; l < parameters.unknown_lengths().size(); ++l) {
    const Length& length = parameters.unknown_lengths()[l];
    const Eigen::Index k = model.length_begin() + static_cast<int>(l);
    // theta_k moves by `gain` times the errors of the whitened x.
    VectorXd gain = VectorXd::Zero(w.value.size());
    for (Eigen::Index d = 0; d < rank; ++d) {
      gain += step.svd.matrixV()(k, d) / s[d] * step.svd.matrixU().col(d);
    }
    const bool seen = Unseen(step, k) < kUnseenAbove;
    result.push_back({length.owner_name, length.name, length.value,
                      seen ? theta[k] : near[static_cast<int>(l)],
                      std::sqrt(gain.dot(w.noise * gain)) / step.scale[k],
                      seen});
  }
  return result;
}

}  // namespace armcal

#include "calib/diagnose/judge/corrected_posterior.h"

#include <algorithm>
#include <cmath>

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// A column that is held acts on no joint; of those of the day, it is known to
// be 0.
bool IsHeld(const GapFit& fit, int column) {
  const std::vector<BaselineColumns>& joints = fit.data()->columns();
  return std::none_of(joints.begin(), joints.end(),
                      [&](const BaselineColumns& of_joint) {
                        return std::binary_search(of_joint.which.begin(),
                                                  of_joint.which.end(), column);
                      });
}

std::vector<int> OpenColumns(const GapFit& fit) {
  using Kind = BaselineColumn::Kind;
  std::vector<int> open;
  for (int c = 0; c < fit.baseline().num_model_columns(); ++c) {
    const Kind kind = fit.baseline().columns()[c].kind;
    if (kind == Kind::kReversal) continue;
    if (kind == Kind::kDay && IsHeld(fit, c)) continue;
    open.push_back(c);
  }
  return open;
}

// The parameters whose covariance is `of_all`'s rows, in its order.
std::vector<CorrectedPosterior::Parameter> AllParameters(
    const std::vector<GapCandidate>& effects) {
  std::vector<CorrectedPosterior::Parameter> all;
  for (size_t e = 0; e < effects.size(); ++e) {
    for (int k = 0; k < effects[e].p.size(); ++k) {
      all.push_back({static_cast<int>(e), k});
    }
  }
  return all;
}

// What the baseline's values are the more, per unit of a parameter: a central
// difference over a part of its standard deviation, within which its law is
// taken as straight.
VectorXd SlopeOf(const GapFit& fit, const CorrectedPosterior::Parameter& of,
                 double stddev) {
  constexpr double kStep = .1;
  std::vector<GapCandidate> effects = fit.refined().effects;
  double* const p = &effects[of.effect].p[of.index];
  const double at = *p;
  *p = at + kStep * stddev;
  const VectorXd more = fit.BaselineGiven(effects);
  *p = at - kStep * stddev;
  return (more - fit.BaselineGiven(effects)) / (2 * kStep * stddev);
}

}  // namespace

VectorXd CorrectedPosterior::ModelAt(const VectorXd& values) const {
  VectorXd x = model;
  x(columns) = values.head(static_cast<Eigen::Index>(columns.size()));
  return x;
}

std::vector<GapCandidate> CorrectedPosterior::EffectsAt(
    const VectorXd& values) const {
  std::vector<GapCandidate> changed = effects;
  for (size_t k = 0; k < parameters.size(); ++k) {
    changed[parameters[k].effect].p[parameters[k].index] =
        values[static_cast<Eigen::Index>(columns.size() + k)];
  }
  return changed;
}

// Given the effects' parameters p the model's values x are those that fit best,
// x(p), with the covariance C of the regression; p itself has the covariance P
// of the refinement. By the law of total covariance, S the slopes of x(p):
//   Cov(p) = P,   Cov(x, p) = S P,   Cov(x) = C + S P S'.
CorrectedPosterior PosteriorOf(const GapFit& fit) {
  CorrectedPosterior posterior;
  posterior.model = fit.model_after();
  posterior.effects = fit.refined().effects;
  posterior.columns = OpenColumns(fit);
  const MatrixXd& of_all = fit.refined().covariance;
  const auto all = AllParameters(posterior.effects);
  std::vector<int> open;
  for (size_t k = 0; k < all.size(); ++k) {
    const double variance = of_all(k, k);
    if (!(variance > 0) || !std::isfinite(variance)) continue;
    open.push_back(static_cast<int>(k));
    posterior.parameters.push_back(all[k]);
  }
  const MatrixXd P = of_all(open, open);
  const Eigen::Index n = static_cast<Eigen::Index>(posterior.columns.size()),
                     m = static_cast<Eigen::Index>(open.size());
  MatrixXd S(n, m);
  posterior.mean.resize(n + m);
  posterior.mean.head(n) = posterior.model(posterior.columns);
  for (Eigen::Index k = 0; k < m; ++k) {
    const auto& parameter = posterior.parameters[k];
    S.col(k) = SlopeOf(fit, parameter, std::sqrt(P(k, k)))(posterior.columns);
    posterior.mean[n + k] =
        posterior.effects[parameter.effect].p[parameter.index];
  }
  posterior.covariance.resize(n + m, n + m);
  posterior.covariance << fit.screen().BaselineCovariance()(posterior.columns,
                                                            posterior.columns) +
                              S * P * S.transpose(),
      S * P, P * S.transpose(), P;
  return posterior;
}

}  // namespace armcal

#include "calib/diagnose/select/evidence_noise.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "calib/numerics/block_bootstrap.h"

namespace armcal {
namespace {

using Eigen::VectorXd;

constexpr int kRoundsOfVariance = 6, kRoundsWithTime = 4, kRoundsOfOdds = 3;
constexpr int kRoundsOfFitted = 3;
constexpr double kVarianceSettled = .01;  // of a variance's logarithm
constexpr double kLeast = 1e-24;          // (N m)^2

GapScreen::Fit FitAll(const GapScreen& screen) {
  std::vector<int> all(screen.size());
  std::iota(all.begin(), all.end(), 0);
  return screen.Solve(all);
}

// A screen whose rows have these standard deviations, and what it leaves.
struct Weighed {
  GapScreen screen;
  VectorXd stddev;
  GapScreen::Fit fit;

  void Weigh(const VectorXd& wanted) {
    screen.Weigh(stddev.cwiseQuotient(wanted));
    stddev = wanted;
    fit = FitAll(screen);
  }
  // Of all joints, in their own units.
  JointRows Residuals() const {
    JointRows residuals = screen.Residuals(fit);
    for (size_t j = 0; j < residuals.size(); ++j) residuals[j] *= stddev[j];
    return residuals;
  }
  // The variance of each joint's rows at the fixed point of the fit,
  //   v = (|r|^2 + tr(A C A')) / N,
  // where tr(A C A') = fitted v: the residual of a fit is smaller than the
  // noise by what its parameters took up, and the posterior of these gives it
  // back (the expectation step of Dempster, Laird and Rubin 1977). `fitted`:
  // how many of a joint's rows the baseline fits, in units of rows of variance
  // `before`, of which it can be no more than nine tenths of all.
  VectorXd Variances(const VectorXd& fitted, const VectorXd& before) const {
    const JointRows residuals = Residuals();
    VectorXd variance(before.size());
    for (int j = 0; j < variance.size(); ++j) {
      const double rows = std::max(1, screen.num_rows(j));
      const double left = residuals[j].squaredNorm();
      variance[j] = std::max(
          kLeast, (left + std::min(fitted[j], .9 * rows) * before[j]) / rows);
    }
    return variance;
  }
};

VectorXd TimesOf(const JointRows& residuals) {
  VectorXd times(residuals.size());
  for (int j = 0; j < times.size(); ++j) {
    const VectorXd& rows = residuals[j];
    times[j] = CorrelationTime({rows.data(), rows.data() + rows.size()});
  }
  return times;
}

double MostChange(const VectorXd& before, const VectorXd& after) {
  return (after.array() / before.array()).log().abs().maxCoeff();
}

// Alternates weights 1 / (v_j time_j) and variances until these change by less
// than kVarianceSettled, with the times held. The number of fitted rows costs
// an inverse of the information, changes slowly, and is renewed every third
// round only.
void Settle(int rounds, Weighed* weighed, EvidenceNoise* noise) {
  for (int round = 0; round < rounds; ++round) {
    weighed->Weigh(noise->stddev());
    // These change slowly, and cost an inverse.
    if (round % kRoundsOfFitted == 0) {
      noise->fitted = weighed->screen.FittedRows();
    }
    // In units of rows of this variance.
    const VectorXd variance = weighed->Variances(
        noise->fitted.cwiseProduct(noise->time), noise->variance);
    const double change = MostChange(noise->variance, variance);
    noise->variance = variance;
    if (change < kVarianceSettled) break;
  }
  weighed->Weigh(noise->stddev());
}

// Variances of one model under times that are given, a few rounds from `start`.
// The number of rows that the baseline fits is taken over from there, the same
// for both models that are compared.
VectorXd VariancesUnder(const VectorXd& time, const EvidenceNoise& start,
                        Weighed* weighed) {
  VectorXd variance = start.variance;
  for (int round = 0; round < kRoundsOfOdds; ++round) {
    weighed->Weigh(variance.cwiseProduct(time).cwiseSqrt());
    variance = weighed->Variances(start.fitted, variance);
  }
  return variance;
}

}  // namespace

// First as if all rows were independent, which has the variance right and says
// how the residual is correlated; then with each joint's integrated
// autocorrelation time, 1 + 2 sum of the correlations over Geyer's initial
// positive sequence (1992), as the factor by which its rows count less.
EvidenceNoise SettleNoise(GapScreen screen, VectorXd stddev) {
  const int n = screen.num_joints();
  Weighed weighed{std::move(screen), std::move(stddev), {}};
  weighed.fit = FitAll(weighed.screen);
  const VectorXd none = VectorXd::Zero(n);
  EvidenceNoise noise{weighed.Variances(none, none), VectorXd::Ones(n), none};
  Settle(kRoundsOfVariance, &weighed, &noise);
  noise.time = TimesOf(weighed.Residuals());
  Settle(kRoundsWithTime, &weighed, &noise);
  return noise;
}

// The marginal likelihood of a linear model with Gaussian priors, by Laplace's
// formula, which is exact here (MacKay 1992; Rasmussen and Williams 2006,
// 2.2.4):
//   2 log p = -[sum_j N_j / time_j log v_j + chi^2 + ln det(information)],
// chi^2 holding both the residual and the prior's share. Dividing N_j by time_j
// is the composite likelihood of Ribatet, Cooley and Davison (2012), which
// counts independent samples and not rows. Constants that models of the same
// rows and times share are left out.
double LogEvidence(GapScreen screen, const EvidenceNoise& before) {
  EvidenceNoise noise = before;
  Weighed weighed{std::move(screen), noise.stddev(), {}};
  Settle(kRoundsWithTime, &weighed, &noise);
  double cost = weighed.screen.PriorCost(weighed.fit) +
                weighed.screen.LogDeterminant(weighed.fit);
  const JointRows residuals = weighed.screen.Residuals(weighed.fit);
  for (int j = 0; j < weighed.screen.num_joints(); ++j) {
    cost += weighed.screen.num_rows(j) / noise.time[j] *
                std::log(noise.variance[j]) +
            residuals[j].squaredNorm();
  }
  return -cost;
}

double LikeliestScale(const GapScreen& screen, const EvidenceNoise& noise,
                      const std::vector<int>& which,
                      const std::vector<double>& factors) {
  double likeliest = 1, most = -std::numeric_limits<double>::infinity();
  for (const double factor : factors) {
    GapScreen scaled = screen;
    scaled.ScaleBaseline(which, factor);
    const double evidence = LogEvidence(std::move(scaled), noise);
    if (evidence <= most) continue;
    most = evidence;
    likeliest = factor;
  }
  return likeliest;
}

// The correlation time of each joint is the smaller one of what both models
// leave, in practice the larger model's: two likelihoods that are tempered by
// different exponents are not comparable, and the better model is the better
// judge of how white the rest is. With variances at each model's own fixed
// point the quadratic terms are N_j / time_j in both and cancel; the logarithms
// of the variances remain, and what the baseline's values cost by their prior.
// What is missing hides the rest of its joint from the baseline, too, so that
// the times are looked at again once the larger model's own variances weigh it.
LargerModel CompareLarger(const GapScreen& smaller, const GapScreen& larger,
                          const EvidenceNoise& noise) {
  const int n = smaller.num_joints();
  Weighed with{larger, noise.stddev(), FitAll(larger)};
  Weighed without{smaller, noise.stddev(), FitAll(smaller)};
  VectorXd time = noise.time.cwiseMin(TimesOf(with.Residuals()));
  VariancesUnder(time, noise, &with);
  time = time.cwiseMin(TimesOf(with.Residuals()));
  const VectorXd v1 = VariancesUnder(time, noise, &with);
  const VectorXd v0 = VariancesUnder(time, noise, &without);
  double odds =
      without.screen.PriorCost(without.fit) - with.screen.PriorCost(with.fit);
  for (int j = 0; j < n; ++j) {
    odds += smaller.num_rows(j) / time[j] * std::log(v0[j] / v1[j]);
  }
  return {odds, v0 - v1};
}

}  // namespace armcal

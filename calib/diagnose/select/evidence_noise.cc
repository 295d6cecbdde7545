#include "calib/diagnose/select/evidence_noise.h"

#include <algorithm>
#include <cmath>
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
  // Joint j's, in its own unit.
  VectorXd Residual(int j) const { return stddev[j] * screen.Residual(j, fit); }
  // `fitted`: rows that the baseline fits, of variance `before`.
  double Variance(int j, double fitted, double before) const {
    const double rows = std::max(1, screen.num_rows(j));
    const double left = Residual(j).squaredNorm();
    return std::max(kLeast,
                    (left + std::min(fitted, .9 * rows) * before) / rows);
  }
};

double TimeOf(const VectorXd& residual) {
  return CorrelationTime({residual.data(), residual.data() + residual.size()});
}

double MostChange(const VectorXd& before, const VectorXd& after) {
  return (after.array() / before.array()).log().abs().maxCoeff();
}

// Rounds of variances and weights, times as they are.
void Settle(int rounds, Weighed* weighed, EvidenceNoise* noise) {
  for (int round = 0; round < rounds; ++round) {
    weighed->Weigh(noise->stddev());
    // These change slowly, and cost an inverse.
    if (round % kRoundsOfFitted == 0) {
      noise->fitted = weighed->screen.FittedRows();
    }
    VectorXd variance = noise->variance;
    for (int j = 0; j < variance.size(); ++j) {
      // In units of rows of this variance.
      const double fitted = noise->fitted[j] * noise->time[j];
      variance[j] = weighed->Variance(j, fitted, variance[j]);
    }
    const double change = MostChange(noise->variance, variance);
    noise->variance = variance;
    if (change < kVarianceSettled) break;
  }
  weighed->Weigh(noise->stddev());
}

// Variances under given times, the rows that a baseline fits being known.
VectorXd VariancesUnder(const VectorXd& time, const EvidenceNoise& start,
                        Weighed* weighed) {
  VectorXd variance = start.variance;
  for (int round = 0; round < kRoundsOfOdds; ++round) {
    weighed->Weigh(variance.cwiseProduct(time).cwiseSqrt());
    for (int j = 0; j < variance.size(); ++j) {
      variance[j] = weighed->Variance(j, start.fitted[j], variance[j]);
    }
  }
  return variance;
}

}  // namespace

EvidenceNoise SettleNoise(GapScreen screen, VectorXd stddev) {
  const int n = screen.num_joints();
  Weighed weighed{std::move(screen), std::move(stddev), {}};
  weighed.fit = FitAll(weighed.screen);
  EvidenceNoise noise{VectorXd(n), VectorXd::Ones(n), VectorXd::Zero(n)};
  for (int j = 0; j < n; ++j) noise.variance[j] = weighed.Variance(j, 0, 0);
  Settle(kRoundsOfVariance, &weighed, &noise);
  for (int j = 0; j < n; ++j) noise.time[j] = TimeOf(weighed.Residual(j));
  Settle(kRoundsWithTime, &weighed, &noise);
  return noise;
}

double LogEvidence(GapScreen screen, const EvidenceNoise& before) {
  EvidenceNoise noise = before;
  Weighed weighed{std::move(screen), noise.stddev(), {}};
  Settle(kRoundsWithTime, &weighed, &noise);
  double cost = weighed.screen.PriorCost(weighed.fit) +
                weighed.screen.LogDeterminant(weighed.fit);
  for (int j = 0; j < weighed.screen.num_joints(); ++j) {
    cost += weighed.screen.num_rows(j) / noise.time[j] *
                std::log(noise.variance[j]) +
            weighed.screen.Residual(j, weighed.fit).squaredNorm();
  }
  return -cost;
}

double LargerModelOdds(const GapScreen& smaller, const GapScreen& larger,
                       const EvidenceNoise& noise) {
  const int n = smaller.num_joints();
  Weighed with{larger, noise.stddev(), FitAll(larger)};
  Weighed without{smaller, noise.stddev(), FitAll(smaller)};
  VectorXd time(n);
  for (int j = 0; j < n; ++j) {
    time[j] = std::min(noise.time[j], TimeOf(with.Residual(j)));
  }
  const VectorXd v1 = VariancesUnder(time, noise, &with);
  const VectorXd v0 = VariancesUnder(time, noise, &without);
  double odds =
      without.screen.PriorCost(without.fit) - with.screen.PriorCost(with.fit);
  for (int j = 0; j < n; ++j) {
    odds += smaller.num_rows(j) / time[j] * std::log(v0[j] / v1[j]);
  }
  return odds;
}

}  // namespace armcal

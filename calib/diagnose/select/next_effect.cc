#include "calib/diagnose/select/next_effect.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "calib/diagnose/data/thresholds.h"
#include "calib/diagnose/select/chosen.h"
#include "calib/diagnose/select/evidence_noise.h"
#include "calib/diagnose/select/selection.h"

namespace armcal {
namespace {

using Eigen::VectorXd;

constexpr int kPlaces = 8;  // that are looked at in full, by each ranking

// The odds that a candidate would have if all rows were independent,
//   N log(v0 / v1) = -N log(1 - f),
// f the share of what is left of its joint (of the arm, where it has none) that
// it explains by itself: delta_chi2 over the chi squared N / time of rows that
// are weighed by 1 / (v time).
double HopefulOdds(const GapRegression& regression, int joint,
                   double delta_chi2) {
  constexpr double kMost = 1 - 1e-6;
  const GapScreen& screen = regression.screen();
  const VectorXd& time = regression.evidence().time;
  double rows = 0, chi2 = 0;
  for (int j = 0; j < screen.num_joints(); ++j) {
    if (joint >= 0 && joint != j) continue;
    rows += screen.num_rows(j);
    chi2 += screen.num_rows(j) / time[j];
  }
  if (!(chi2 > 0)) return 0;
  return -rows * std::log1p(-std::min(delta_chi2 / chi2, kMost));
}

// The best places by their scores, and by their hopeful odds. An effect that is
// missing makes the residual large and correlated, and so hides itself: scores
// by that residual's variance and autocorrelation time (evidence_noise.h) have
// effects on other joints before it, however small these are. Hopeful odds are
// too hopeful, but leave no effect out of the few that are then compared in
// full.
std::vector<int> Shortlist(const GapRegression& regression,
                           const std::vector<GapCandidate>& candidates,
                           const SelectionOptions& options,
                           const std::vector<int>& set) {
  const GapScreen& screen = regression.screen();
  const VectorXd scores = ScoresGiven(screen, candidates, options, set, -1);
  VectorXd hopeful = scores;
  for (size_t i = 0; i < candidates.size(); ++i) {
    if (std::isinf(scores[i])) continue;
    const double penalty = Penalty(screen, candidates[i]);
    const double delta_chi2 = options.inflation * (scores[i] + penalty);
    hopeful[i] =
        HopefulOdds(regression, candidates[i].joint, delta_chi2) - penalty;
  }
  std::vector<int> list = BestPlaces(candidates, scores, kPlaces);
  for (const int c : BestPlaces(candidates, hopeful, kPlaces)) {
    if (std::count(list.begin(), list.end(), c) == 0) list.push_back(c);
  }
  return list;
}

// Of all rows, in units of the torque's noise, of a variance per joint.
double InNoise(const GapRegression& regression, const VectorXd& variance) {
  double sum = 0;
  for (int j = 0; j < variance.size(); ++j) {
    const double noise = regression.noise().joints[j].stddev();
    sum += regression.screen().num_rows(j) * variance[j] / (noise * noise);
  }
  return sum;
}

// The most probable one above the threshold, of those that explain most of the
// gap (`all` in units of `explained`) where there are such; -1: none. What is
// left of a joint that lacks much is correlated and tells less, so that odds
// alone would take several small effects on joints with white noise before the
// one that is the gap.
int Likeliest(const VectorXd& scores, const VectorXd& explained, double all,
              double threshold) {
  const auto best_beyond = [&](double least) {
    int best = -1;
    for (Eigen::Index i = 0; i < scores.size(); ++i) {
      if (!(scores[i] > threshold) || explained[i] < least) continue;
      if (best < 0 || scores[i] > scores[best]) best = static_cast<int>(i);
    }
    return best;
  };
  const int of_most = best_beyond(Limits().explains * all);
  return of_most >= 0 ? of_most
                      : best_beyond(-std::numeric_limits<double>::infinity());
}

}  // namespace

NextEffect NextOf(const GapRegression& regression,
                  const std::vector<GapCandidate>& candidates,
                  const SelectionOptions& options, const std::vector<int>& set,
                  const GapScreen& smaller) {
  const GapScreen& screen = regression.screen();
  const std::vector<int> list = Shortlist(regression, candidates, options, set);
  NextEffect step;
  if (list.empty()) return step;
  VectorXd scores(list.size()), explained(list.size());
  tbb::parallel_for(size_t{0}, list.size(), [&](size_t i) {
    std::vector<int> more = set;
    more.push_back(list[i]);
    const LargerModel larger =
        CompareLarger(smaller, screen.Only(ColumnsOf(candidates, more)),
                      regression.evidence());
    scores[i] = larger.odds - Penalty(screen, candidates[list[i]]);
    explained[i] = InNoise(regression, larger.explained);
  });
  Eigen::Index likeliest;
  step.best_odds = scores.maxCoeff(&likeliest);
  step.best = list[likeliest];
  const int best = Likeliest(
      scores, explained, InNoise(regression, regression.evidence().variance),
      options.threshold);
  if (best < 0) return step;
  step.candidate = list[best];
  step.odds = scores[best];
  return step;
}

double ScoreTogether(const GapRegression& regression,
                     const std::vector<GapCandidate>& candidates,
                     const std::vector<int>& set, const GapScreen& smaller,
                     const std::vector<int>& together,
                     const std::vector<JointRows>& columns) {
  const GapScreen& screen = regression.screen();
  std::vector<int> more = set;
  double penalty = 0;
  for (const int c : together) {
    if (std::count(set.begin(), set.end(), c) > 0) continue;
    more.push_back(c);
    penalty += Penalty(screen, candidates[c]);
  }
  GapScreen larger = screen.Only(ColumnsOf(candidates, more));
  for (const JointRows& column : columns) {
    for (const VectorXd& rows : column) {
      if (rows.size() > 0) penalty += std::log(rows.size());
    }
    larger.AddColumn(column);
  }
  larger.Factor();
  return CompareLarger(smaller, larger, regression.evidence()).odds - penalty;
}

}  // namespace armcal

#include "calib/diagnose/select/growth.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "calib/diagnose/candidates/effect_odds.h"
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

// 2 log of the odds of a set with these candidates and columns (of one joint
// each) as well against it alone (`smaller`), less their penalties.
double ScoreTogether(const GapRegression& regression,
                     const std::vector<GapCandidate>& candidates,
                     const std::vector<int>& set, const GapScreen& smaller,
                     const std::vector<int>& together,
                     const std::vector<JointRows>& columns = {}) {
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

std::vector<int> Offsets(const std::vector<GapCandidate>& candidates) {
  std::vector<int> offsets;
  for (int c = 0; c < static_cast<int>(candidates.size()); ++c) {
    if (candidates[c].effect->joint_term == JointTerm::kOffset) {
      offsets.push_back(c);
    }
  }
  return offsets;
}

// The offsets of all joints and the rest of a set.
std::vector<int> WithOffsets(const std::vector<GapCandidate>& candidates,
                             const std::vector<int>& set) {
  std::vector<int> more = Offsets(candidates);
  for (const int c : set) {
    if (candidates[c].effect->joint_term != JointTerm::kOffset) {
      more.push_back(c);
    }
  }
  return more;
}

// Whether offsets on several joints, none of which could be spared, are
// together likelier than what is likeliest by itself (`best`, above the
// threshold). Zeros of torque sensors and drives wander from day to day on all
// joints, each by so little that another effect on many joints (an added mass)
// is likelier than any of these offsets, and stands for them.
bool MayZerosHaveMoved(const GapRegression& regression,
                       const std::vector<GapCandidate>& candidates,
                       const SelectionOptions& options,
                       const std::vector<int>& set, const GapScreen& smaller,
                       double best) {
  const GapScreen& screen = regression.screen();
  const std::vector<int> offsets = Offsets(candidates);
  if (static_cast<double>(offsets.size()) < Limits().several_joints) {
    return false;
  }
  if (ScoreTogether(regression, candidates, set, smaller, offsets) <
      std::max(best, options.threshold)) {
    return false;
  }
  const std::vector<int> more = WithOffsets(candidates, set);
  const GapScreen larger = screen.Only(ColumnsOf(candidates, more));
  const VectorXd stddev = regression.evidence().stddev();
  int needed = 0;
  for (size_t k = 0; k < offsets.size(); ++k) {
    const GapScreen without =
        screen.Only(ColumnsOf(candidates, Without(more, static_cast<int>(k))));
    const LargerModel with =
        CompareLarger(without, larger, SettleNoise(without, stddev));
    needed +=
        with.odds - Penalty(screen, candidates[offsets[k]]) > options.threshold;
  }
  return needed >= Limits().several_joints;
}

// Of each joint the candidate of this effect that scores best by itself; none
// where no effect has that name.
std::vector<int> BestOfEachJoint(const GapRegression& regression,
                                 const std::vector<GapCandidate>& candidates,
                                 const SelectionOptions& options,
                                 const std::vector<int>& set,
                                 const std::string& name) {
  const GapScreen& screen = regression.screen();
  const VectorXd scores = ScoresGiven(screen, candidates, options, set, -1);
  std::vector<int> best(screen.num_joints(), -1);
  for (int k = 0; k < static_cast<int>(candidates.size()); ++k) {
    if (candidates[k].effect->name != name || std::isinf(scores[k])) continue;
    int& of_joint = best[candidates[k].joint];
    if (of_joint < 0 || scores[k] > scores[of_joint]) of_joint = k;
  }
  best.erase(std::remove(best.begin(), best.end(), -1), best.end());
  return best;
}

// Whether candidate c, of all joints and with these odds less its penalty, is
// less likely than what looks so where each joint has it by itself:
//   - another effect (Effect::if_of_each_joint), of each joint the shape that
//     scores best;
//   - friction that changes sign earlier or later than the recorded velocity,
//     by a time of each joint's own, where inertia and gravity are in time
//     (Effect::moves_reversals): friction that yields before it breaks away,
//     that creeps, or that a simulator keeps smooth;
//   - both.
// It is as if it were that, too, where torque is late and joints have friction
// of their own besides: then it is still asked for beside them, by inertia and
// gravity that are late as well.
// One number for all joints costs less than one for each, and of few effects
// that a selection may have it explains the most; so that it would stand for
// all of them.
bool IsOfEachJoint(const GapRegression& regression,
                   const std::vector<GapCandidate>& candidates,
                   const SelectionOptions& options, const std::vector<int>& set,
                   const GapScreen& smaller, int c, double odds) {
  const Effect& effect = *candidates[c].effect;
  // Likelier than the candidate, and no likelier with it.
  const auto is_it = [&](std::vector<int> others,
                         const std::vector<JointRows>& columns) {
    const auto score = [&] {
      return ScoreTogether(regression, candidates, set, smaller, others,
                           columns);
    };
    const double without = score();
    if (!(without > odds)) return false;
    others.push_back(c);
    return without >= score();
  };
  const std::vector<int> others = BestOfEachJoint(
      regression, candidates, options, set, effect.if_of_each_joint);
  if (!others.empty() && is_it(others, {})) return true;
  if (!effect.moves_reversals) return false;
  const std::vector<JointRows> late =
      LateFriction(regression.baseline(), *regression.data());
  return is_it({}, late) || is_it(others, late);
}

// The next effect of a set, and its odds less its penalty; -1: none is above
// the threshold.
struct NextEffect {
  int candidate = -1;
  double odds = -std::numeric_limits<double>::infinity();
  double best_odds = -std::numeric_limits<double>::infinity();  // of all
};

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
  step.best_odds = scores.maxCoeff();
  const int best = Likeliest(
      scores, explained, InNoise(regression, regression.evidence().variance),
      options.threshold);
  if (best < 0) return step;
  step.candidate = list[best];
  step.odds = scores[best];
  return step;
}

// 2 log of the odds of all that is added to a set, effect by effect.
double OddsOfTheRest(const std::vector<GapCandidate>& candidates,
                     const SelectionOptions& options, std::vector<int> set,
                     size_t most, GapRegression* regression) {
  double odds = 0;
  while (set.size() < most) {
    regression->SettleEvidence(ColumnsOf(candidates, set));
    const NextEffect step =
        NextOf(*regression, candidates, options, set,
               regression->screen().Only(ColumnsOf(candidates, set)));
    if (step.candidate < 0) break;
    odds += step.odds;
    set.push_back(step.candidate);
  }
  return odds;
}

// Whether zeros of torques have moved on several joints. Where they may have,
// they are held against all effects that would else be taken one by one: of
// what a payload and another effect make together they explain more than the
// payload does.
bool HaveZerosMoved(const std::vector<GapCandidate>& candidates,
                    const SelectionOptions& options,
                    const std::vector<int>& set, const GapScreen& smaller,
                    const NextEffect& next, GapRegression* regression) {
  if (!MayZerosHaveMoved(*regression, candidates, options, set, smaller,
                         next.best_odds)) {
    return false;
  }
  const std::vector<int> offsets = Offsets(candidates),
                         with = WithOffsets(candidates, set);
  const size_t most = options.most_effects;
  const double zeros =
      ScoreTogether(*regression, candidates, set, smaller, offsets) +
      OddsOfTheRest(candidates, options, with, most + with.size() - set.size(),
                    regression);
  const double effects =
      OddsOfTheRest(candidates, options, set, most, regression);
  regression->SettleEvidence(ColumnsOf(candidates, set));
  return zeros > effects;
}

}  // namespace

// Forward selection by the odds of the larger model against the smaller one,
//   CompareLarger(set, set + candidate).odds - Penalty(candidate),
// both under the correlation that the larger one leaves. This differs from the
// scores of SelectEffects in that variance and correlation time are functions
// of the model and not of the data: N / time log(v0 / v1) grows without bound
// as an effect explains the whole residual, whereas delta_chi2 under the
// smaller model's variance is N / time at most. After each step the regression
// is weighed by what the set leaves (SettleEvidence), for which the next
// candidate has to be seen.
Growth GrowEffects(const std::vector<GapCandidate>& candidates,
                   const SelectionOptions& options, GapRegression* regression) {
  std::vector<int> set;
  regression->SettleEvidence({});
  while (static_cast<int>(set.size()) < options.most_effects) {
    const GapScreen smaller =
        regression->screen().Only(ColumnsOf(candidates, set));
    const NextEffect next =
        NextOf(*regression, candidates, options, set, smaller);
    if (regression->HoldsZeros() &&
        HaveZerosMoved(candidates, options, set, smaller, next, regression)) {
      return {set, true, -1};
    }
    if (next.candidate < 0) break;
    if (IsOfEachJoint(*regression, candidates, options, set, smaller,
                      next.candidate, next.odds)) {
      return {set, false, next.candidate};
    }
    set.push_back(next.candidate);
    regression->SettleEvidence(ColumnsOf(candidates, set));
  }
  return {set, false, -1};
}

}  // namespace armcal

#include "calib/diagnose/select/selection.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

#include "calib/diagnose/data/thresholds.h"
#include "calib/diagnose/select/chosen.h"
#include "calib/diagnose/select/form_error.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kNever = -std::numeric_limits<double>::infinity();

// ln N, the penalty of one parameter by the Bayesian information criterion
// (Schwarz 1978): N counts the rows of the joints on which the candidate acts,
// since the others say nothing of it.
double LogOfRows(const GapScreen& screen, const GapCandidate& candidate) {
  double rows = 0;
  for (int j = 0; j < screen.num_joints(); ++j) {
    if (candidate.joint < 0 || candidate.joint == j) rows += screen.num_rows(j);
  }
  return std::log(std::max(rows, 1.0));
}

int Best(const VectorXd& scores) {
  int best;
  scores.maxCoeff(&best);
  return best;
}

// Each chosen one is replaced by the candidate that scores best given the
// others, until none changes: coordinate ascent on the score of the set. A
// forward search takes the best single explanation first, which may stand for
// two effects at once and be superseded once one of them is in.
void Swap(const GapScreen& screen, const std::vector<GapCandidate>& candidates,
          const SelectionOptions& options, std::vector<int>* chosen) {
  constexpr int kRounds = 3;
  for (int round = 0; round < kRounds; ++round) {
    bool changed = false;
    for (size_t k = 0; k < chosen->size(); ++k) {
      const int best = Best(ScoresGiven(screen, candidates, options, *chosen,
                                        static_cast<int>(k)));
      changed |= best != (*chosen)[k];
      (*chosen)[k] = best;
    }
    if (!changed) return;
  }
}

// The backward half of a stepwise search (Efroymson 1960): members are dropped
// whose score given the others is below the threshold.
void LeaveOut(const GapScreen& screen,
              const std::vector<GapCandidate>& candidates,
              const SelectionOptions& options, std::vector<int>* chosen) {
  for (int k = 0; k < static_cast<int>(chosen->size());) {
    const VectorXd scores =
        ScoresGiven(screen, candidates, options, *chosen, k);
    if (scores[(*chosen)[k]] < options.threshold) {
      *chosen = Without(*chosen, k);
    } else {
      ++k;
    }
  }
}

// Scores in addition to a set. What would explain too little given it has none:
// it is as likely an error in the form of one that is chosen (IsLarge). A score
// is delta_chi2 / inflation less the penalty, from which the gain in chi
// squared is recovered here.
VectorXd LargeScores(const GapScreen& screen,
                     const std::vector<GapCandidate>& candidates,
                     const SelectionOptions& options,
                     const std::vector<int>& set) {
  VectorXd scores = ScoresGiven(screen, candidates, options, set, -1);
  if (set.empty()) return scores;
  const std::vector<double> delta_chi2 =
      DeltaChi2OfEach(screen, candidates, set);
  const int strongest =
      set[std::max_element(delta_chi2.begin(), delta_chi2.end()) -
          delta_chi2.begin()];
  const double before = TotalDeltaChi2(screen, candidates, set);
  std::vector<int> more = set;
  more.push_back(0);
  for (size_t i = 0; i < candidates.size(); ++i) {
    if (scores[i] == kNever) continue;
    more.back() = static_cast<int>(i);
    const double gain =
        options.inflation * (scores[i] + Penalty(screen, candidates[i]));
    if (!IsLarge(screen, candidates, options, strongest, more.back(),
                 {set, more, gain, before})) {
      scores[i] = kNever;
    }
  }
  return scores;
}

// Sets of one more than those of `sets`, the best first: one step of a beam
// search. The best single explanation may be neither of two that explain
// everything together (Cover 1974, "The best two independent measurements are
// not the two best"), so the kSets best sets of each size are followed and not
// one. The total of a set is that of its members less their penalties,
//   delta_chi2(set) / inflation - sum of penalties,
// to which a further candidate adds its score given the set, so that no set has
// to be solved anew for being ranked.
std::vector<std::vector<int>> Extended(
    const GapScreen& screen, const std::vector<GapCandidate>& candidates,
    const SelectionOptions& options,
    const std::vector<std::vector<int>>& sets) {
  constexpr int kSets = 8;
  std::map<std::vector<int>, double> totals;
  for (const std::vector<int>& set : sets) {
    double own = TotalDeltaChi2(screen, candidates, set) / options.inflation;
    for (const int c : set) own -= Penalty(screen, candidates[c]);
    const VectorXd scores = LargeScores(screen, candidates, options, set);
    for (const int c : BestPlaces(candidates, scores, kSets)) {
      std::vector<int> more = set;
      more.push_back(c);
      std::sort(more.begin(), more.end());
      if (!AreLarge(screen, candidates, options, {}, more)) continue;
      totals[more] = own + scores[c];
    }
  }
  std::vector<std::vector<int>> best;
  for (const auto& [set, total] : totals) best.push_back(set);
  std::sort(best.begin(), best.end(), [&](const auto& a, const auto& b) {
    return totals[a] > totals[b];
  });
  if (best.size() > kSets) best.resize(kSets);
  return best;
}

}  // namespace

// k ln N is the Bayesian information criterion's penalty of k linear parameters
// (Schwarz 1978). The shape was chosen as the best of `tried` ones, of which
// each is a hypothesis of its own with a prior of 1 / tried: 2 ln(tried), a
// Bonferroni correction on the scale of chi squared.
double Penalty(const GapScreen& screen, const GapCandidate& candidate) {
  return candidate.linear.size() * LogOfRows(screen, candidate) +
         2 * std::log(candidate.tried) + candidate.prior_penalty;
}

// A shape that is fitted is a parameter as others are and has ln N as its
// penalty, instead of 2 ln(tried) for a choice from a grid; the larger of both
// counts, so that refining is never cheaper than having looked.
double RefinedPenalty(const GapScreen& screen, const GapCandidate& candidate,
                      int varied) {
  const double shapes = varied - static_cast<double>(candidate.linear.size());
  return Penalty(screen, candidate) +
         std::max(0., shapes * LogOfRows(screen, candidate) -
                          2 * std::log(candidate.tried));
}

VectorXd ScoresGiven(const GapScreen& screen,
                     const std::vector<GapCandidate>& candidates,
                     const SelectionOptions& options,
                     const std::vector<int>& chosen, int k) {
  return ScoresInAddition(screen, candidates, options,
                          Without(chosen, k))(screen.g());
}

ScoresInAddition::ScoresInAddition(const GapScreen& screen,
                                   const std::vector<GapCandidate>& candidates,
                                   const SelectionOptions& options,
                                   const std::vector<int>& others)
    : delta_chi2_(screen, candidates, ColumnsOf(candidates, others)),
      inflation_(options.inflation) {
  for (const GapCandidate& candidate : candidates) {
    const bool taken = std::any_of(
        others.begin(), others.end(),
        [&](int other) { return SamePlace(candidates[other], candidate); });
    const bool possible = options.events || candidate.log < 0;
    penalty_.push_back(taken || !possible ? -kNever
                                          : Penalty(screen, candidate));
  }
}

VectorXd ScoresInAddition::operator()(const VectorXd& gradient) const {
  const VectorXd g = delta_chi2_.Conditioned(gradient);
  VectorXd scores(penalty_.size());
  for (size_t i = 0; i < penalty_.size(); ++i) {
    scores[i] = std::isinf(penalty_[i])
                    ? kNever
                    : delta_chi2_.Of(i, g) / inflation_ - penalty_[i];
  }
  return scores;
}

std::vector<int> BestPlaces(const std::vector<GapCandidate>& candidates,
                            VectorXd scores, int count) {
  std::vector<int> best;
  while (static_cast<int>(best.size()) < count) {
    int c;
    if (!(scores.maxCoeff(&c) > 0)) break;
    best.push_back(c);
    for (size_t i = 0; i < candidates.size(); ++i) {
      if (SamePlace(candidates[i], candidates[c])) scores[i] = kNever;
    }
  }
  return best;
}

// The chosen in the order of their delta_chi2 given all others. Both figures
// are those of leaving one out, and do not depend on the order in which a
// search came to the set.
Selection DescribeSelection(const GapScreen& screen,
                            const std::vector<GapCandidate>& candidates,
                            const SelectionOptions& options,
                            const std::vector<int>& chosen) {
  Selection selection;
  const std::vector<double> delta_chi2 =
      DeltaChi2OfEach(screen, candidates, chosen);
  std::vector<double> scores;
  for (size_t k = 0; k < chosen.size(); ++k) {
    scores.push_back(ScoresGiven(screen, candidates, options, chosen,
                                 static_cast<int>(k))[chosen[k]]);
  }
  std::vector<int> order(chosen.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(),
            [&](int a, int b) { return delta_chi2[a] > delta_chi2[b]; });
  for (const int k : order) {
    selection.chosen.push_back(chosen[k]);
    selection.delta_chi2.push_back(delta_chi2[k]);
    selection.scores.push_back(scores[k]);
  }
  return selection;
}

// Sizes are tried in turn, 1, 2, .. most_effects, from the sets that the beam
// search has at each. The best set of a size is improved by exchange (Swap),
// and becomes the answer where all of its members pass the threshold given the
// others and are large enough to be no errors of form (AreLarge); else the set
// that was not exchanged is asked. The search ends at the first size that has
// neither. The accepted set is put first among those that are extended, though
// exchange may have taken it outside of the beam.
Selection SelectEffects(const GapScreen& screen,
                        const std::vector<GapCandidate>& candidates,
                        const SelectionOptions& options) {
  std::vector<int> chosen;
  std::vector<std::vector<int>> sets = {{}};
  for (int size = 1; size <= options.most_effects; ++size) {
    sets = Extended(screen, candidates, options, sets);
    if (sets.empty()) break;
    const auto is_better = [&](std::vector<int>* more) {
      LeaveOut(screen, candidates, options, more);
      return static_cast<int>(more->size()) == size &&
             (size == 1 ||
              AreLarge(screen, candidates, options, chosen, *more));
    };
    std::vector<int> swapped = sets[0], more = sets[0];
    Swap(screen, candidates, options, &swapped);
    if (is_better(&swapped)) {
      chosen = swapped;
    } else if (is_better(&more)) {
      chosen = more;
    } else {
      break;
    }
    sets.insert(sets.begin(), chosen);
  }
  return DescribeSelection(screen, candidates, options, chosen);
}

}  // namespace armcal

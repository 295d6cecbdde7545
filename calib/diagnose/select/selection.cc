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

// Of the joints that show it: what BIC asks of a parameter.
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

// Each chosen one is replaced by what does better beside the others.
void Swap(const GapScreen& screen, const std::vector<GapCandidate>& candidates,
          const SelectionOptions& options, std::vector<int>* chosen) {
  constexpr int kRounds = 3;
  for (int round = 0; round < kRounds; ++round) {
    bool changed = false;
    for (size_t k = 0; k < chosen->size(); ++k) {
      const int best = Best(ScoresBeside(screen, candidates, options, *chosen,
                                         static_cast<int>(k)));
      changed |= best != (*chosen)[k];
      (*chosen)[k] = best;
    }
    if (!changed) return;
  }
}

void LeaveOut(const GapScreen& screen,
              const std::vector<GapCandidate>& candidates,
              const SelectionOptions& options, std::vector<int>* chosen) {
  for (int k = 0; k < static_cast<int>(chosen->size());) {
    const VectorXd scores =
        ScoresBeside(screen, candidates, options, *chosen, k);
    if (scores[(*chosen)[k]] < options.threshold) {
      *chosen = Without(*chosen, k);
    } else {
      ++k;
    }
  }
}

// Scores in addition to a set; those that explain too little beside it, errors
// of its forms as likely as not, never.
VectorXd LargeScores(const GapScreen& screen,
                     const std::vector<GapCandidate>& candidates,
                     const SelectionOptions& options,
                     const std::vector<int>& set) {
  VectorXd scores = ScoresBeside(screen, candidates, options, set, -1);
  if (set.empty()) return scores;
  const std::vector<double> drops = Drops(screen, candidates, set);
  const int strongest =
      set[std::max_element(drops.begin(), drops.end()) - drops.begin()];
  const double before = TotalDrop(screen, candidates, set);
  std::vector<int> more = set;
  more.push_back(0);
  for (size_t i = 0; i < candidates.size(); ++i) {
    if (scores[i] == kNever) continue;
    more.back() = static_cast<int>(i);
    const double gain =
        options.inflation * (scores[i] + Price(screen, candidates[i]));
    if (!IsLarge(screen, candidates, options, strongest, more.back(),
                 {set, more, gain, before})) {
      scores[i] = kNever;
    }
  }
  return scores;
}

// Sets of one more than those of `sets`, the best first. What explains most
// alone may be neither of two that explain everything together: several sets
// are followed, not only the best.
std::vector<std::vector<int>> Extended(
    const GapScreen& screen, const std::vector<GapCandidate>& candidates,
    const SelectionOptions& options,
    const std::vector<std::vector<int>>& sets) {
  constexpr int kSets = 8;
  std::map<std::vector<int>, double> totals;
  for (const std::vector<int>& set : sets) {
    double own = TotalDrop(screen, candidates, set) / options.inflation;
    for (const int c : set) own -= Price(screen, candidates[c]);
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

double Price(const GapScreen& screen, const GapCandidate& candidate) {
  return candidate.linear.size() * LogOfRows(screen, candidate) +
         2 * std::log(candidate.tried) +
         (candidate.effect->near_zero ? Limits().near_zero_price : 0);
}

double RefinedPrice(const GapScreen& screen, const GapCandidate& candidate,
                    int varied) {
  const double shapes = varied - static_cast<double>(candidate.linear.size());
  return Price(screen, candidate) +
         std::max(0., shapes * LogOfRows(screen, candidate) -
                          2 * std::log(candidate.tried));
}

VectorXd ScoresBeside(const GapScreen& screen,
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
    : drops_(screen, candidates, ColumnsOf(candidates, others)),
      inflation_(options.inflation) {
  for (const GapCandidate& candidate : candidates) {
    const bool taken = std::any_of(
        others.begin(), others.end(),
        [&](int other) { return SamePlace(candidates[other], candidate); });
    const bool possible = options.events || candidate.log < 0;
    price_.push_back(taken || !possible ? -kNever : Price(screen, candidate));
  }
}

VectorXd ScoresInAddition::operator()(const VectorXd& gradient) const {
  const VectorXd g = drops_.Conditioned(gradient);
  VectorXd scores(price_.size());
  for (size_t i = 0; i < price_.size(); ++i) {
    scores[i] = std::isinf(price_[i])
                    ? kNever
                    : drops_.Of(i, g) / inflation_ - price_[i];
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

Selection DescribeSelection(const GapScreen& screen,
                            const std::vector<GapCandidate>& candidates,
                            const SelectionOptions& options,
                            const std::vector<int>& chosen) {
  Selection selection;
  const std::vector<double> drops = Drops(screen, candidates, chosen);
  std::vector<double> scores;
  for (size_t k = 0; k < chosen.size(); ++k) {
    scores.push_back(ScoresBeside(screen, candidates, options, chosen,
                                  static_cast<int>(k))[chosen[k]]);
  }
  std::vector<int> order(chosen.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(),
            [&](int a, int b) { return drops[a] > drops[b]; });
  for (const int k : order) {
    selection.chosen.push_back(chosen[k]);
    selection.drops.push_back(drops[k]);
    selection.scores.push_back(scores[k]);
  }
  return selection;
}

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

#include "calib/diagnose/select/growth.h"

#include <tbb/parallel_for.h>

#include <algorithm>

#include "calib/diagnose/select/chosen.h"
#include "calib/diagnose/select/evidence_noise.h"
#include "calib/diagnose/select/selection.h"

namespace armcal {
namespace {

using Eigen::VectorXd;

constexpr int kPlaces = 8;  // that are looked at in full, by each ranking

// The best places by their scores, and by those that they would have if all
// rows were independent. Rows are weighed by 1 / (v time), time the
// autocorrelation time of what is left (evidence_noise.h); an effect that is
// missing makes that residual correlated, and so hides itself. Multiplied by
// the time again its delta_chi2 is that of white noise, which is too hopeful,
// but leaves no effect out of the few that are then compared in full.
std::vector<int> Shortlist(const GapRegression& regression,
                           const std::vector<GapCandidate>& candidates,
                           const SelectionOptions& options,
                           const std::vector<int>& set) {
  const GapScreen& screen = regression.screen();
  const VectorXd scores = ScoresGiven(screen, candidates, options, set, -1);
  const VectorXd& time = regression.evidence().time;
  VectorXd hopeful = scores;
  for (size_t i = 0; i < candidates.size(); ++i) {
    const int j = candidates[i].joint;
    const double penalty = Penalty(screen, candidates[i]);
    hopeful[i] =
        (scores[i] + penalty) * (j < 0 ? time.mean() : time[j]) - penalty;
  }
  std::vector<int> list = BestPlaces(candidates, scores, kPlaces);
  for (const int c : BestPlaces(candidates, hopeful, kPlaces)) {
    if (std::count(list.begin(), list.end(), c) == 0) list.push_back(c);
  }
  return list;
}

}  // namespace

// Forward selection by the odds of the larger model against the smaller one,
//   LargerModelOdds(set, set + candidate) - Penalty(candidate),
// both under the correlation that the larger one leaves. This differs from the
// scores of SelectEffects in that variance and correlation time are functions
// of the model and not of the data: N / time log(v0 / v1) grows without bound
// as an effect explains the whole residual, whereas delta_chi2 under the
// smaller model's variance is N / time at most. After each step the regression
// is weighed by what the set leaves (SettleEvidence), for which the next
// candidate has to be seen.
std::vector<int> GrowEffects(const std::vector<GapCandidate>& candidates,
                             const SelectionOptions& options,
                             GapRegression* regression) {
  std::vector<int> set;
  regression->SettleEvidence({});
  while (static_cast<int>(set.size()) < options.most_effects) {
    const GapScreen& screen = regression->screen();
    const std::vector<int> list =
        Shortlist(*regression, candidates, options, set);
    if (list.empty()) break;
    const GapScreen smaller = screen.Only(ColumnsOf(candidates, set));
    VectorXd scores(list.size());
    tbb::parallel_for(size_t{0}, list.size(), [&](size_t i) {
      std::vector<int> more = set;
      more.push_back(list[i]);
      scores[i] =
          LargerModelOdds(smaller, screen.Only(ColumnsOf(candidates, more)),
                          regression->evidence()) -
          Penalty(screen, candidates[list[i]]);
    });
    int best;
    if (!(scores.maxCoeff(&best) > options.threshold)) break;
    set.push_back(list[best]);
    regression->SettleEvidence(ColumnsOf(candidates, set));
  }
  return set;
}

}  // namespace armcal

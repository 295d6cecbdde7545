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
// rows were independent: what an effect leaves unexplained is correlated, and
// so makes itself small.
std::vector<int> Shortlist(const GapRegression& regression,
                           const std::vector<GapCandidate>& candidates,
                           const SelectionOptions& options,
                           const std::vector<int>& set) {
  const GapScreen& screen = regression.screen();
  const VectorXd scores = ScoresBeside(screen, candidates, options, set, -1);
  const VectorXd& time = regression.evidence().time;
  VectorXd hopeful = scores;
  for (size_t i = 0; i < candidates.size(); ++i) {
    const int j = candidates[i].joint;
    const double price = Price(screen, candidates[i]);
    hopeful[i] = (scores[i] + price) * (j < 0 ? time.mean() : time[j]) - price;
  }
  std::vector<int> list = BestPlaces(candidates, scores, kPlaces);
  for (const int c : BestPlaces(candidates, hopeful, kPlaces)) {
    if (std::count(list.begin(), list.end(), c) == 0) list.push_back(c);
  }
  return list;
}

}  // namespace

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
          Price(screen, candidates[list[i]]);
    });
    int best;
    if (!(scores.maxCoeff(&best) > options.threshold)) break;
    set.push_back(list[best]);
    regression->SettleEvidence(ColumnsOf(candidates, set));
  }
  return set;
}

}  // namespace armcal

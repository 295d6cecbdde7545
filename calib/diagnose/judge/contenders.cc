#include "calib/diagnose/judge/contenders.h"

#include <algorithm>
#include <iterator>
#include <set>

namespace armcal {
namespace {

// A column at a size of the grid, times a factor, is the torque of no size. The
// choice of the whole fit was made again after such columns had been replaced
// by those at fitted sizes (CandidatePool::Sharpen), which a choice on less
// data is not: they would win there by a course that no effect has.
bool IsOfNoSize(const GapCandidate& candidate) {
  return candidate.effect->proportional && candidate.is_larger &&
         !candidate.is_fitted;
}

}  // namespace

std::vector<int> Contenders(const GapFit& fit) {
  constexpr int kMost = 24;
  const std::vector<GapCandidate>& candidates = fit.candidates();
  const std::vector<int>& chosen = fit.selection().chosen;
  std::set<int> all(chosen.begin(), chosen.end());
  const auto add = [&](const std::vector<int>& given, int k) {
    Eigen::VectorXd scores = ScoresGiven(fit.screen(), candidates,
                                         fit.selection_options(), given, k);
    for (size_t i = 0; i < candidates.size(); ++i) {
      if (IsOfNoSize(candidates[i])) scores[i] = 0;
    }
    const std::vector<int> best = BestPlaces(candidates, scores, kMost);
    all.insert(best.begin(), best.end());
  };
  add({}, -1);
  add(chosen, -1);
  for (size_t k = 0; k < chosen.size(); ++k) {
    add(chosen, static_cast<int>(k));
  }
  std::vector<int> contenders;
  std::copy_if(all.begin(), all.end(), std::back_inserter(contenders),
               [&](int c) { return candidates[c].log < 0; });
  return contenders;
}

}  // namespace armcal

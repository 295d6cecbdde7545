#include "calib/diagnose/select/redundant.h"

#include <tbb/parallel_for.h>

#include <algorithm>

#include "calib/diagnose/select/chosen.h"
#include "calib/diagnose/select/form_error.h"

namespace armcal {

// The selection judged columns, linear in an effect's size; here the laws are
// fitted as they are. For each effect k the others are fitted without it, and
//   (delta_chi2 of all - delta_chi2 without k) / inflation - penalty of k
// is compared to the threshold of the selection. A gap or a wind-up that is
// large leaves a residual beyond its column, which a second effect may have
// explained; once the first is fitted in full the second has nothing left to
// do. The lowest score goes first, since leaving it out changes those of the
// rest.
int FindRedundant(const GapRegression& regression, const CandidatePool& pool,
                  const SelectionOptions& options, const Selection& selection,
                  const RefinedEffects& refined) {
  if (refined.effects.size() < 2) return -1;
  std::vector<double> without(refined.effects.size());  // their delta_chi2
  tbb::parallel_for(size_t{0}, without.size(), [&](size_t k) {
    without[k] = RefineEffects(regression.screen(), regression.baseline(),
                               regression.scale(), AllBut(refined.effects, k),
                               -1, regression.data())
                     .delta_chi2;
  });
  int redundant = -1;
  double least = options.threshold;
  for (size_t k = 0; k < without.size(); ++k) {
    const double score =
        (refined.delta_chi2 - without[k]) / options.inflation -
        Penalty(regression.screen(), pool.candidates()[selection.chosen[k]]);
    if (score >= least) continue;
    least = score;
    redundant = static_cast<int>(k);
  }
  return redundant;
}

// The column of a law that bends, as of an elastic joint, is right at its size
// and where nothing else acts: with other effects, and times a factor, it is
// the torque of no law, and may fit all the better. Fitted as it is, that law
// then is worth nothing:
//   delta_chi2 of all, fitted - that of the others' columns - penalty of k
// is below 0. That of another such law is, too, beside it: of several, the one
// without which the others, fitted as they are, explain most.
int FindHollow(const GapScreen& screen,
               const std::vector<GapCandidate>& candidates,
               const Selection& selection, const RefinedEffects& refined,
               const std::function<double(size_t)>& fitted_without) {
  std::vector<int> hollow;
  for (int k = 0; k < static_cast<int>(selection.chosen.size()); ++k) {
    const GapCandidate& own = candidates[selection.chosen[k]];
    if (own.effect->larger_sizes.empty()) continue;
    const double score =
        refined.delta_chi2 -
        TotalDeltaChi2(screen, candidates, Without(selection.chosen, k)) -
        Penalty(screen, own);
    if (score < 0) hollow.push_back(k);
  }
  if (hollow.size() < 2) return hollow.empty() ? -1 : hollow[0];
  std::vector<double> without;
  for (const int k : hollow) without.push_back(fitted_without(k));
  return hollow[std::max_element(without.begin(), without.end()) -
                without.begin()];
}

}  // namespace armcal

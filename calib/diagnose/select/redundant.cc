#include "calib/diagnose/select/redundant.h"

#include <tbb/parallel_for.h>

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

}  // namespace armcal

#include "calib/diagnose/select/idle.h"

namespace armcal {

int FindIdle(const GapRegression& regression, const CandidatePool& pool,
             const SelectionOptions& options, const Selection& selection,
             const RefinedEffects& refined) {
  if (refined.effects.size() < 2) return -1;
  int idle = -1;
  double least = options.threshold;
  for (size_t k = 0; k < refined.effects.size(); ++k) {
    const RefinedEffects without = RefineEffects(
        regression.screen(), regression.baseline(), regression.scale(),
        AllBut(refined.effects, k), -1, regression.data());
    const double score =
        (refined.drop - without.drop) / options.inflation -
        Price(regression.screen(), pool.candidates()[selection.chosen[k]]);
    if (score >= least) continue;
    least = score;
    idle = static_cast<int>(k);
  }
  return idle;
}

}  // namespace armcal

#include "calib/diagnose/judge/body_places.h"

#include <algorithm>
#include <vector>

#include "calib/diagnose/data/thresholds.h"

namespace armcal {

// FoundEffect::equivalent begins with the most probable ones.
void PoolPlacesOfBody(FoundEffect* found) {
  if (!IsCarriedBody(*found->effect)) return;
  std::vector<PlacedEffect> others;
  double all = found->probability;
  for (const PlacedEffect& other : found->equivalent) {
    if (!IsCarriedBody(*other.effect)) continue;
    others.push_back(other);
    all += other.probability;
  }
  double told = found->probability;
  for (const PlacedEffect& other : others) {
    if (told >= Limits().credible * all) break;
    found->or_at.push_back(other);
    told += other.probability;
  }
  found->probability = told;
  found->any_probability = std::max(told, found->any_probability);
}

}  // namespace armcal

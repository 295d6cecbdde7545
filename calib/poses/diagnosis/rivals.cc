#include "calib/poses/diagnosis/rivals.h"

#include <algorithm>
#include <cmath>

#include "calib/poses/diagnosis/scan.h"

namespace armcal {
namespace {

using Eigen::VectorXd;

// Rivals that are fitted; to first order the others explain less.
constexpr size_t kFittedRivals = 6;
// A rival less likely than this is none: "strong" evidence against it (Kass and
// Raftery 1995, 20 to 1).
constexpr double kRivalWeight = .05;

// Other forms of an effect on the same joints are the same effect.
bool IsSameCause(const PlacedPoseEffect& a, const PlacedPoseEffect& b) {
  return a.effect == b.effect && a.place.joint == b.place.joint &&
         a.place.by == b.place.by;
}

}  // namespace

// Fits the model with each rival in the effect's place. Evidences are -2 log p,
// so that weights are exp(-difference / 2), and the effect's probability is 1
// over the sum of all, itself and none included (Kass & Raftery 1995).
PoseRivals FindRivals(const PoseStudy& study, const PoseModel& model,
                      size_t effect, double design_effect) {
  const PlacedPoseEffect own = model.effects[effect];
  PoseRivals found;
  found.without = FitWithout(study, model, effect);
  const double evidence = EvidenceOf(study, model, design_effect);
  const auto weight = [&](const PoseModel& other) {
    const double worse = EvidenceOf(study, other, design_effect) - evidence;
    return std::exp(-.5 * std::clamp(worse, -60.0, 600.0));
  };
  const double none = weight(found.without);
  double sum = 1 + none;
  std::vector<PlacedPoseEffect> tried;
  for (const ScannedEffect& scanned :
       ScanEffects(study, found.without, false)) {
    if (tried.size() == kFittedRivals) break;
    if (IsSameCause(scanned.placed, own)) continue;
    const bool again = std::any_of(
        tried.begin(), tried.end(),
        [&](const auto& o) { return IsSameCause(o, scanned.placed); });
    if (again) continue;
    tried.push_back(scanned.placed);
    std::vector<PlacedPoseEffect> effects = found.without.effects;
    effects.push_back(scanned.placed);
    PoseModel other = FitPoseModel(study, effects, found.without,
                                   VectorXd::Zero(scanned.amounts.size()));
    if (!IsPossible(other)) continue;
    const double w = weight(other);
    sum += w;
    if (w > kRivalWeight) found.rivals.push_back({scanned.placed, w, other});
  }
  found.probability = 1 / sum;
  found.none = none / sum;
  std::sort(found.rivals.begin(), found.rivals.end(),
            [](const PoseRival& a, const PoseRival& b) {
              return a.weight > b.weight;
            });
  return found;
}

}  // namespace armcal

#include "calib/diagnose/judge/shared_mean.h"

#include <algorithm>
#include <cmath>

namespace armcal {
namespace {

// Itself among those that may stand in its place.
std::vector<PlacedEffect> WithItself(const FoundEffect& found) {
  std::vector<PlacedEffect> all = found.equivalent;
  all.insert(all.begin(),
             {found.effect, found.joint, found.probability, found.score});
  return all;
}

// That this effect, or a law of its joint whose mean it is, is there.
double ProbabilityAsMean(const PlacedEffect& mean,
                         const std::vector<PlacedEffect>& all) {
  double sum = 0;
  for (const PlacedEffect& law : all) {
    if (law.joint != mean.joint) continue;
    if (law.effect != mean.effect && !HasMean(*law.effect, *mean.effect)) {
      continue;
    }
    sum += law.probability;
  }
  return sum;
}

// The candidate of this effect on this joint that scores best in the k-th
// place; -1: there is none.
int BestCandidateOf(const Effect& effect, int joint, const GapFit& fit,
                    size_t k) {
  const Eigen::VectorXd scores =
      ScoresGiven(fit.screen(), fit.candidates(), fit.selection_options(),
                  fit.selection().chosen, static_cast<int>(k));
  int best = -1;
  for (int c = 0; c < scores.size(); ++c) {
    const GapCandidate& candidate = fit.candidates()[c];
    if (candidate.effect != &effect || candidate.joint != joint) continue;
    if (!std::isfinite(scores[c])) continue;
    if (best < 0 || scores[c] > scores[best]) best = c;
  }
  return best;
}

}  // namespace

FoundEffect AsSharedMean(const FoundEffect& found) {
  if (found.fitted.size() != 1 || found.joint < 0) return found;
  const std::vector<PlacedEffect> all = WithItself(found);
  const PlacedEffect* mean = nullptr;
  double most = found.probability;
  for (const PlacedEffect& one : all) {
    const double probability = ProbabilityAsMean(one, all);
    if (one.joint != found.joint || !(probability > most)) continue;
    mean = &one;
    most = probability;
  }
  if (mean == nullptr) return found;
  FoundEffect shared = found;
  shared.effect = mean->effect;
  shared.probability = most;
  shared.any_probability = std::max(most, found.any_probability);
  shared.separate_by = mean->effect->experiment;
  shared.equivalent.clear();
  for (const PlacedEffect& one : all) {
    if (one.effect == mean->effect && one.joint == mean->joint) continue;
    shared.equivalent.push_back(one);
  }
  return shared;
}

bool PutMeansInPlace(const std::vector<FoundEffect>& effects, GapFit* fit) {
  bool any = false;
  for (const FoundEffect& found : effects) {
    if (found.fitted.size() != 1) continue;
    const int k = found.fitted[0];
    if (fit->refined().effects[k].effect == found.effect) continue;
    const int mean = BestCandidateOf(*found.effect, found.joint, *fit, k);
    if (mean < 0) continue;
    fit->Exchange(k, mean);
    any = true;
  }
  return any;
}

}  // namespace armcal

#include "calib/diagnose/judge/probability.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "calib/diagnose/data/thresholds.h"

namespace armcal {

std::vector<PlacedEffect> Alternatives(const GapFit& fit, size_t k) {
  const std::vector<GapCandidate>& candidates = fit.candidates();
  const GapCandidate& chosen = candidates[fit.selection().chosen[k]];
  const Eigen::VectorXd scores =
      ScoresBeside(fit.screen(), candidates, fit.selection_options(),
                   fit.selection().chosen, static_cast<int>(k));
  std::map<std::pair<const Effect*, int>, double> best;
  for (size_t i = 0; i < candidates.size(); ++i) {
    if (!std::isfinite(scores[i])) continue;
    const auto place =
        std::make_pair(candidates[i].effect, candidates[i].joint);
    const auto found = best.emplace(place, scores[i]).first;
    found->second = std::max(found->second, scores[i]);
  }
  // What fitting the shape of the chosen one gained, the others may have
  // gained too where it was not tried.
  if (!fit.rivals(k).empty()) {
    double grid = 0, fitted = -1e300;
    for (const RefinedScore& rival : fit.rivals(k)) {
      if (rival.score <= fitted) continue;
      fitted = rival.score;
      grid = best[{rival.effect, rival.joint}];
    }
    for (auto& [place, score] : best) score += std::max(0., fitted - grid);
    for (const RefinedScore& rival : fit.rivals(k)) {
      const auto place = std::make_pair(rival.effect, rival.joint);
      best[place] = rival.score;
      const bool is_chosen =
          place == std::make_pair(chosen.effect, chosen.joint);
      if (!rival.is_possible && !is_chosen) best.erase(place);
    }
  }
  std::vector<PlacedEffect> all;
  for (const auto& [place, score] : best) {
    all.push_back({place.first, place.second, 0, score});
  }
  std::sort(all.begin(), all.end(),
            [](const PlacedEffect& a, const PlacedEffect& b) {
              return a.score > b.score;
            });
  double sum = 0;
  for (PlacedEffect& effect : all) {
    effect.probability =
        std::exp((effect.score - all[0].score) / (2 * Limits().temperature));
    sum += effect.probability;
  }
  for (PlacedEffect& effect : all) effect.probability /= sum;
  return all;
}

double ProbabilityBeyondChance(double chance, double odds_before) {
  if (chance <= 0) return 1;
  const double bound = chance < 1 / M_E ? -M_E * chance * std::log(chance) : 1;
  return 1 / (1 + odds_before * bound);
}

std::vector<PlacedEffect> CredibleSet(const std::vector<PlacedEffect>& all) {
  std::vector<PlacedEffect> set;
  double sum = 0;
  for (const PlacedEffect& effect : all) {
    if (sum >= Limits().credible) break;
    sum += effect.probability;
    set.push_back(effect);
  }
  return set;
}

}  // namespace armcal

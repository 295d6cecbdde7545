#include "calib/diagnose/judge/probability.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "calib/diagnose/data/thresholds.h"

namespace armcal {

// The softmax
//   P_i = exp((s_i - s_max) / (2 T)) / sum.
// Scores are on the scale of chi squared and T divides them, since neither
// noise nor catalogue nor the form of a law is as they assume: with T = 1 they
// would be posterior odds and far too certain (a tempered likelihood, Holmes
// and Walker 2017). One score that is not finite would leave no probability
// that is.
std::vector<PlacedEffect> ByScore(std::vector<PlacedEffect> all) {
  all.erase(std::remove_if(all.begin(), all.end(),
                           [](const PlacedEffect& effect) {
                             return !std::isfinite(effect.score);
                           }),
            all.end());
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

// Every effect at every place that could stand where the k-th does, with its
// best score over all shapes. Where the shape of the chosen one was fitted, the
// others get the same gain, unless they were fitted too; a rival that no real
// arm can have is out.
std::vector<PlacedEffect> Alternatives(const GapFit& fit, size_t k) {
  const std::vector<GapCandidate>& candidates = fit.candidates();
  const GapCandidate& chosen = candidates[fit.selection().chosen[k]];
  const Eigen::VectorXd scores =
      ScoresGiven(fit.screen(), candidates, fit.selection_options(),
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
      if (!std::isfinite(rival.score) || rival.score <= fitted) continue;
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
  return ByScore(std::move(all));
}

// A p-value is no probability of the hypothesis. For p below 1/e the odds
// against an effect that is there are at least -e p ln p times those before,
// over all alternatives that make small p-values likelier (Sellke, Bayarri and
// Berger 2001). That bound is taken for their value, and the probability is no
// larger than 1 / (1 + odds_before (-e p ln p)).
double ProbabilityBeyondChance(double chance, double odds_before) {
  if (chance <= 0) return 1;
  const double bound = chance < 1 / M_E ? -M_E * chance * std::log(chance) : 1;
  return 1 / (1 + odds_before * bound);
}

// The smallest set of the most probable ones whose sum is Limits().credible:
// the highest posterior density set of a discrete distribution.
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

#include "calib/gap_rivals.h"

#include <algorithm>
#include <limits>

#include "calib/gap_coordinates.h"
#include "calib/gap_form_error.h"
#include "calib/gap_refinement.h"

namespace armcal {
namespace {

using Eigen::VectorXd;

constexpr double kOut = -std::numeric_limits<double>::infinity();

}  // namespace

Rivals CompareRivals(const GapRegression& regression, const CandidatePool& pool,
                     const SelectionOptions& options,
                     const Selection& selection, int k) {
  constexpr int kMostRivals = 3;
  constexpr double kNear = .5;  // of the drop
  const GapScreen& screen = regression.screen();
  const std::vector<GapCandidate>& candidates = pool.candidates();
  VectorXd scores =
      ScoresBeside(screen, candidates, options, selection.chosen, k);
  const double least =
      selection.scores[k] - std::max(20., kNear * selection.drops[k]);
  const double by_others =
      TotalDrop(screen, candidates, Without(selection.chosen, k));
  // What happened once is no rival of what lasts: it was taken out.
  for (int i = 0; i < scores.size(); ++i) {
    if (candidates[i].log >= 0) scores[i] = kOut;
  }
  Rivals rivals{{}, selection.chosen[k]};
  double best_score = kOut;
  while (static_cast<int>(rivals.scores.size()) < 1 + kMostRivals) {
    int c;
    if (!(scores.maxCoeff(&c) >= least)) break;
    const GapCandidate& rival = candidates[c];
    std::vector<int> chosen = selection.chosen;
    chosen[k] = c;
    const GapBaseline& baseline = regression.baseline();
    const MotionScale& scale = regression.scale();
    const RefinedEffects refined = RefineEffects(
        screen, baseline, scale, pool.Fitted(chosen), k, regression.data());
    const size_t varied = ListCoordinates(baseline, scale, {rival}, 0).size();
    const double score = refined.drop - by_others -
                         RefinedPrice(screen, rival, static_cast<int>(varied));
    rivals.scores.push_back({rival.effect, rival.joint, score});
    if (score > best_score) best_score = score, rivals.best = c;
    for (int i = 0; i < scores.size(); ++i) {
      if (SamePlace(candidates[i], rival)) scores[i] = kOut;
    }
  }
  return rivals;
}

}  // namespace armcal

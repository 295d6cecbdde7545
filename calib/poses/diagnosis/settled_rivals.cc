#include "calib/poses/diagnosis/settled_rivals.h"

#include <algorithm>
#include <utility>

#include "calib/poses/diagnosis/confirmation.h"

namespace armcal {
namespace {

// Rivals that take an effect's place; each is better than the one before.
constexpr int kMostExchanges = 4;

// Rivals of each effect. One that is likelier than an effect, and that held-out
// poses confirm, takes its place first.
std::vector<PoseRivals> WeighRivals(const PoseStudy& study, PoseModel* model,
                                    double* design_effect) {
  const std::vector<int> folds = EverySixthPose(study);
  std::vector<PoseRivals> all;
  for (int exchanged = 0; all.size() < model->effects.size();) {
    all.push_back(FindRivals(study, *model, all.size(), *design_effect));
    const PoseRivals& own = all.back();
    if (exchanged == kMostExchanges || own.rivals.empty()) continue;
    const PoseRival& rival = own.rivals[0];
    if (rival.weight <= 1) continue;
    const HeldOutGain gain =
        CompareHeldOut(study, own.without, rival.model, folds);
    const HeldOutGain before =
        CompareHeldOut(study, own.without, *model, folds);
    if (!gain.IsClear() && gain.deviance < before.deviance) continue;
    PoseModel better = rival.model;
    *model = std::move(better);
    *design_effect = DesignEffect(study, *model);
    all.clear();
    ++exchanged;
  }
  return all;
}

// Of all effects of another model.
std::vector<PoseRivals> WeighAnew(const PoseStudy& study,
                                  const PoseModel& model,
                                  double* design_effect) {
  *design_effect = DesignEffect(study, model);
  std::vector<PoseRivals> rivals;
  for (size_t e = 0; e < model.effects.size(); ++e) {
    rivals.push_back(FindRivals(study, model, e, *design_effect));
  }
  return rivals;
}

}  // namespace

int LeastClaimed(const std::vector<PoseRivals>& rivals) {
  const auto worst = std::max_element(
      rivals.begin(), rivals.end(),
      [](const auto& a, const auto& b) { return a.none < b.none; });
  if (worst == rivals.end() || worst->none < .5) return -1;
  return static_cast<int>(worst - rivals.begin());
}

// Confirms once more what rivals have changed. An effect is then claimed, by
// its name or as one of a few, only where some effect in its place is likelier
// than none: the evidence while the search went on counted errors as more than
// they are. The least likely goes first and the others are weighed anew.
std::vector<PoseRivals> SettleRivals(
    const PoseStudy& study, PoseModel* model, double* design_effect,
    std::vector<UnlikelyPoseEffect>* unlikely) {
  std::vector<PoseRivals> rivals = WeighRivals(study, model, design_effect);
  PoseModel confirmed = ConfirmedPart(study, *model);
  if (confirmed.effects != model->effects) {
    *model = std::move(confirmed);
    rivals = WeighAnew(study, *model, design_effect);
  }
  for (int k = LeastClaimed(rivals); k >= 0; k = LeastClaimed(rivals)) {
    const PlacedPoseEffect& out = model->effects[k];
    unlikely->push_back({PlacedName(*out.effect, model->campaign, out.place),
                         rivals[k].probability, rivals[k].none});
    PoseModel without = rivals[k].without;
    *model = std::move(without);
    rivals = WeighAnew(study, *model, design_effect);
  }
  return rivals;
}

}  // namespace armcal

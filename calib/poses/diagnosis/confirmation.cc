#include "calib/poses/diagnosis/confirmation.h"

#include <algorithm>

#include "calib/poses/diagnosis/held_out.h"

namespace armcal {
namespace {

// Models of the selection that are looked at, likeliest first.
constexpr size_t kMostLookedAt = 6;

}  // namespace

PoseModel ConfirmedPart(const PoseStudy& study, PoseModel model) {
  const std::vector<int> folds = EverySixthPose(study);
  for (bool all = false; !all;) {
    all = true;
    double least = 0;
    PoseModel without;
    for (size_t e = 0; e < model.effects.size(); ++e) {
      PoseModel less = FitWithout(study, model, e);
      const HeldOutGain gain = CompareHeldOut(study, less, model, folds);
      if (gain.IsClear()) continue;
      if (!all && gain.deviance >= least) continue;
      all = false;
      least = gain.deviance;
      without = std::move(less);
    }
    if (!all) model = std::move(without);
  }
  return model;
}

PoseModel ConfirmedModel(const PoseStudy& study,
                         const PoseSelection& selection) {
  const auto evidence = [&](const PoseModel& model) {
    return EvidenceOf(study, model, selection.design_effect);
  };
  PoseModel best = ConfirmedPart(study, selection.models[0]);
  const size_t some = std::min(kMostLookedAt, selection.models.size());
  for (size_t k = 1; k < some; ++k) {
    if (selection.evidence[k] >= evidence(best)) break;
    PoseModel next = ConfirmedPart(study, selection.models[k]);
    if (evidence(next) < evidence(best)) best = std::move(next);
  }
  return best;
}

}  // namespace armcal

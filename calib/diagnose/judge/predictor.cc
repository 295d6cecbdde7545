#include "calib/diagnose/judge/predictor.h"

#include <algorithm>

#include "calib/diagnose/select/chosen.h"
#include "calib/diagnose/select/selection.h"

namespace armcal {

using Eigen::VectorXd;

Predictor::Predictor(const GapFit& fit) : fit_(fit) {}

Predictor::Predictor(const GapFit& fit, int left_out,
                     const std::vector<int>& contenders)
    : fit_(fit),
      own_(std::make_unique<GapRegression>(fit.regression(),
                                           LogPart::OtherFolds(left_out))) {
  Choose(contenders);
}

// Of those that could be chosen at all, under the noise of the whole fit. As in
// that (CompareRivals), what no real arm can have gives way to what one can.
void Predictor::Choose(const std::vector<int>& contenders) {
  std::vector<GapCandidate> candidates;
  for (const int c : contenders) {
    candidates.push_back(fit_.candidates()[c]);
  }
  GapScreen screen = own_->screen();
  AddCandidates(own_->rows(), &candidates, &screen);
  screen.Factor();
  SelectionOptions options = fit_.selection_options();
  options.events = false;
  while (!candidates.empty()) {
    chosen_ = FittedTo(screen, candidates,
                       SelectEffects(screen, candidates, options).chosen);
    const auto impossible =
        std::find_if(chosen_.begin(), chosen_.end(), [&](const auto& one) {
          return !IsPossible(one, fit_.baseline().robot(), fit_.scale());
        });
    if (impossible == chosen_.end()) return;
    const GapCandidate out = *impossible;
    candidates.erase(std::remove_if(candidates.begin(), candidates.end(),
                                    [&out](const GapCandidate& candidate) {
                                      return SamePlace(candidate, out);
                                    }),
                     candidates.end());
    chosen_.clear();
  }
}

bool Predictor::ChoseOneOf(const std::vector<PlacedEffect>& effects) const {
  if (!own_) return true;
  return std::any_of(
      chosen_.begin(), chosen_.end(), [&](const GapCandidate& own) {
        return std::any_of(
            effects.begin(), effects.end(), [&](const PlacedEffect& other) {
              return other.effect == own.effect && other.joint == own.joint;
            });
      });
}

// Values of effects and model are fitted together, from the fit's on. Which
// effects there are was chosen on all of the logs.
void Predictor::Follow(const std::vector<JointRows>& around) {
  refined_ = fit_.refined();
  model_refit_ = fit_.model_refit();
  model_after_ = fit_.model_after();
  if (!own_) return;
  if (refined_.effects.empty()) {
    refined_.baseline = own_->refit();
  } else {
    refined_ = RefineEffects(own_->screen(), own_->baseline(), own_->scale(),
                             refined_.effects, -1, own_->data(),
                             around.empty() ? nullptr : &around);
  }
  model_refit_ = ModelGiven({});
  model_after_ = ModelGiven(refined_.effects);
}

VectorXd Predictor::ModelGiven(const std::vector<GapCandidate>& effects) const {
  return regression().ModelGiven(regression().TorqueOf(effects));
}

VectorXd Predictor::BaselineGiven(
    const std::vector<GapCandidate>& effects) const {
  return regression().BaselineGiven(regression().TorqueOf(effects));
}

}  // namespace armcal

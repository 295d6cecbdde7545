#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <utility>
#include <vector>

#include "calib/diagnose/candidates/refinement.h"
#include "calib/diagnose/select/events.h"
#include "calib/diagnose/select/pool.h"
#include "calib/diagnose/select/regression.h"
#include "calib/diagnose/select/rivals.h"
#include "calib/diagnose/select/selection.h"

namespace armcal {

struct GapFitOptions {
  double bandwidth_hz = 0;
  SelectionOptions selection;
  std::vector<std::string> without;  // effects that are not considered
};

// The regression of a diagnosis on its training logs, and what it chose.
class GapFit {
 public:
  GapFit(const GapBaseline& baseline, const GapFitOptions& options,
         std::vector<GapSegment> training, std::vector<GapSegment> reference);

  // Candidates whose torques are known, for another fit to the same segments,
  // which takes them before it chooses; this one is of no more use.
  std::vector<GapCandidate> TakeEvaluated() { return pool_.TakeEvaluated(); }
  void Reuse(std::vector<GapCandidate> evaluated) {
    pool_.Reuse(std::move(evaluated));
  }

  // Chooses effects and refines them; events are taken out of the data one by
  // one first, since nothing else can be told while they last.
  void Choose();
  // Puts a candidate in the place of the k-th effect, to be fitted by KeepOnly.
  void Exchange(int k, int candidate);
  // Of the effects that were chosen, those with these numbers alone, fitted
  // again: what is not claimed is no part of what is shown.
  void KeepOnly(const std::vector<int>& kept);

  const GapRegression& regression() const { return regression_; }
  const GapBaseline& baseline() const { return regression_.baseline(); }
  const GapNoise& noise() const { return regression_.noise(); }
  const MotionScale& scale() const { return regression_.scale(); }
  const GapScreen& screen() const { return regression_.screen(); }
  const GapRows& rows() const { return regression_.rows(); }
  GapData* data() const { return regression_.data(); }
  const SelectionOptions& selection_options() const {
    return options_.selection;
  }
  bool IsLeftOut(const Effect& effect) const {
    const auto& names = options_.without;
    return std::count(names.begin(), names.end(), effect.name) > 0;
  }
  const std::vector<GapCandidate>& candidates() const {
    return pool_.candidates();
  }
  const Selection& selection() const { return selection_; }
  const RefinedEffects& refined() const { return refined_; }
  // In the order of time.
  const std::vector<GapEvent>& events() const { return events_; }
  // Of the k-th effect.
  const std::vector<RefinedScore>& rivals(size_t k) const {
    return rivals_[k].scores;
  }
  // GapRegression's.
  const Eigen::VectorXd& before() const { return regression_.before(); }
  Eigen::MatrixXd CovarianceBefore() const {
    return regression_.CovarianceBefore();
  }
  const Eigen::VectorXd& refit() const { return regression_.refit(); }
  // Whitened residual of joint j given the refined effects: their torque as it
  // is, not as columns have it.
  const Eigen::VectorXd& Left(int joint) const { return left_[joint]; }
  // Of an effect, per joint thinned samples, N m or N.
  JointRows TorqueOf(const GapCandidate& effect) const {
    return regression_.TorqueOf({effect});
  }
  ReferenceScatter ScatterOf(const GapCandidate& effect) const {
    return regression_.ScatterOf(effect);
  }
  // The baseline's values given other effects.
  Eigen::VectorXd BaselineGiven(const std::vector<GapCandidate>& effects) const;
  // The model's values given other effects, without what models lack as a
  // rule: what a robot file can hold.
  Eigen::VectorXd ModelGiven(const std::vector<GapCandidate>& effects) const;
  // The same without any effect, and given the refined ones.
  const Eigen::VectorXd& model_refit() const { return model_refit_; }
  const Eigen::VectorXd& model_after() const { return model_after_; }
  // What the model leaves of joint j's torque, whitened by the torque's noise
  // alone, with the refined effects or refitted without any.
  Eigen::VectorXd LeftByNoise(int joint, bool with_effects) const;

 private:
  // These effects as they fit best together, from where they are.
  RefinedEffects Fitted(const std::vector<GapCandidate>& effects) const;
  void MakeScreen();
  void FindEvents();
  std::vector<GapEvent> EventsGiven(
      const std::vector<GapCandidate>& effects) const;
  void Select();
  void SelectWithTheirNoise();
  std::vector<int> Grown();
  std::vector<GapEvent> NewContacts(const std::vector<GapCandidate>& effects,
                                    ContactSearch search) const;
  // Whether there were any.
  bool TakeOut(const std::vector<GapEvent>& found);
  bool TakeOutContacts(ContactSearch search);
  bool TakeOutPulses();
  void TakeOutEvent(size_t k);
  double Cost(const Selection& selection) const;
  void ForgetTouchesOfWhatLasts();
  void ForgetEventsOfALaw();
  void SelectGiven(const std::vector<GapEvent>& events);
  void TakeAsKnown(const std::vector<GapEvent>& events);
  void SelectWithEvents();
  void Finish();
  void Refine();
  void FitModels();

  GapFitOptions options_;
  GapRegression regression_;
  CandidatePool pool_;
  Selection selection_;
  RefinedEffects refined_;
  JointRows left_;
  Eigen::VectorXd model_refit_, model_after_;
  std::vector<Rivals> rivals_;
  std::vector<GapEvent> events_;
};

}  // namespace armcal

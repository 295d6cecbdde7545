#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <memory>
#include <optional>
#include <set>
#include <vector>

#include "calib/gap_baseline.h"
#include "calib/gap_candidates.h"
#include "calib/gap_data.h"
#include "calib/gap_events.h"
#include "calib/gap_noise.h"
#include "calib/gap_refinement.h"
#include "calib/gap_screen.h"
#include "calib/gap_selection.h"

namespace armcal {

// The score of an effect whose shape is fitted, not one of a grid.
struct RefinedScore {
  const Effect* effect = nullptr;
  int joint = -1;
  double score = 0;
};

struct GapFitOptions {
  double bandwidth_hz = 0;
  SelectionOptions selection;
  std::vector<std::string> without;  // effects that are not considered
};

// The regression of a diagnosis on its training logs, and what it chose.
class GapFit {
 public:
  // `reference`: logs of the robot before, or none: the baseline is fitted to
  // them as well, and what it leaves of them is the noise that anything new has
  // to rise above.
  GapFit(const GapBaseline& baseline, const GapFitOptions& options,
         std::vector<GapSegment> training, LogPart part,
         std::vector<GapSegment> reference);

  // Chooses effects and refines them; events are taken out of the data one by
  // one first, since nothing else can be told while they last.
  void Choose();
  // The events alone.
  void FindEvents();
  // Effects beside these events, which are all that there were.
  void ChooseBeside(const std::vector<GapEvent>& events);

  const GapBaseline& baseline() const { return baseline_; }
  const GapNoise& noise() const { return noise_; }
  const MotionScale& scale() const { return scale_; }
  const GapScreen& screen() const { return *screen_; }
  const GapRows& rows() const { return data_->rows(); }
  GapData* data() const { return data_.get(); }
  const SelectionOptions& selection_options() const {
    return options_.selection;
  }
  bool IsLeftOut(const Effect& effect) const {
    const auto& names = options_.without;
    return std::count(names.begin(), names.end(), effect.name) > 0;
  }
  const std::vector<GapCandidate>& candidates() const { return candidates_; }
  const Selection& selection() const { return selection_; }
  const RefinedEffects& refined() const { return refined_; }
  // In the order of time.
  const std::vector<GapEvent>& events() const { return events_; }
  // Scores of the k-th effect and its nearest rivals, each with its shape
  // fitted beside the others.
  const std::vector<RefinedScore>& rivals(size_t k) const { return rivals_[k]; }
  // The baseline's values before these logs: the file's, or those of the
  // reference.
  const Eigen::VectorXd& before() const { return before_; }
  // The baseline's values without any effect.
  const Eigen::VectorXd& refit() const { return refit_; }
  // Whitened residual of joint j beside the refined effects: their torque as it
  // is, not as columns have it.
  const Eigen::VectorXd& Left(int joint) const { return left_[joint]; }
  // The baseline beside the refined effects but for the k-th.
  Eigen::VectorXd BaselineWithout(size_t k) const;

 private:
  void EstimateNoise();
  void MakeScreen();
  bool AddLargerOnes();
  bool HoldDays();
  void Refit();
  bool TakeOutContacts(const std::vector<GapCandidate>& effects,
                       ContactSearch search);
  void TakeOutEvent(size_t k);
  double Cost(const Selection& selection) const;
  void ForgetTouches();
  void SelectBeside(const std::vector<GapEvent>& events);
  void SelectWithEvents();
  void Finish();
  double UsualExcess(const FrictionExcess& excess, bool of_itself) const;
  FrictionExcess ExcessBeside(const std::vector<GapCandidate>& effects) const;
  std::vector<GapCandidate> Chosen(const std::vector<int>& chosen) const;
  void CompareRivals(size_t k);

  const GapBaseline& baseline_;
  GapFitOptions options_;
  std::unique_ptr<GapData> data_, reference_;
  GapNoise noise_;
  MotionScale scale_;
  std::optional<GapScreen> screen_;
  std::vector<GapCandidate> candidates_;
  Selection selection_;
  RefinedEffects refined_;
  JointRows left_;
  std::vector<std::vector<RefinedScore>> rivals_;
  std::vector<GapEvent> events_;
  // Whether friction is that of another day than the reference's, and the
  // columns of it that are held nevertheless.
  std::optional<bool> another_day_;
  std::set<int> held_;
  Eigen::VectorXd before_, refit_;
};

}  // namespace armcal

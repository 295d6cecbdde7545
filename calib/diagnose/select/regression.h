#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <set>
#include <vector>

#include "calib/diagnose/candidates/effect_odds.h"
#include "calib/diagnose/candidates/refinement.h"
#include "calib/diagnose/data/baseline.h"
#include "calib/diagnose/data/data.h"
#include "calib/diagnose/data/noise.h"
#include "calib/diagnose/data/screen.h"
#include "calib/diagnose/select/evidence_noise.h"
#include "calib/diagnose/select/reference_scatter.h"

namespace armcal {

// The baseline fitted to logs within its prior, and what a reference tells of
// it; what it leaves of the torque is for effects to explain.
class GapRegression {
 public:
  // `reference`: logs of the robot before, or none: the baseline is fitted to
  // them as well, and what it leaves of them is the noise that anything new has
  // to rise above.
  GapRegression(const GapBaseline& baseline, double bandwidth_hz,
                std::vector<GapSegment> training,
                std::vector<GapSegment> reference);

  // The same model fitted to a part of the same logs, with an empty screen:
  // rows are weighed, masked, and columns held and scaled as there.
  GapRegression(const GapRegression& other, LogPart part);
  // A part of the logs, to be predicted: with these weights.
  std::unique_ptr<GapData> DataOf(LogPart part) const;
  // The same of other logs, of which nothing is masked.
  std::unique_ptr<GapData> DataOf(std::vector<GapSegment> logs) const;
  // Gives such data these weights again, where masks have changed.
  void GiveNoise(GapData* data) const;

  // Anew, with an empty screen: at first, and where masks have changed.
  void Refit();
  // Whether what had looked like another day than the reference's is none
  // given these effects; friction is held from the next Refit on.
  bool IsTheSameDayGiven(const std::vector<GapCandidate>& effects);

  // What the baseline and these columns of the screen leave is the noise of the
  // evidence from now on; the screen's rows are weighed anew. Torques that were
  // reconstructed from commands keep the noise of their positions.
  void SettleEvidence(const std::vector<int>& columns);
  // The same with this noise, per joint (N m or N), of another fit.
  void WeighBy(const Eigen::VectorXd& stddev);
  // Whether zeros of torques are held at those of the reference, or of the
  // calibration; and frees them, from the next Refit on.
  bool HoldsZeros() const { return holds_zeros_; }
  void FreeZeros();
  // Gives what models lack as a rule the size, of the routine one and smaller
  // ones, that is the most likely given these columns; once, before the next
  // Refit, and where no reference has told it. Whether that changed it.
  bool ChooseDiscrepancy(const std::vector<int>& columns);
  // How large what models lack as a rule is on joint j at any one time, a
  // standard deviation, N m or N (Discrepancy::Deviation at the chosen size).
  double DiscrepancyOn(int j) const;
  const EvidenceNoise& evidence() const { return evidence_; }
  const GapBaseline& baseline() const { return baseline_; }
  const GapNoise& noise() const { return noise_; }
  const MotionScale& scale() const { return scale_; }
  const GapScreen& screen() const { return *screen_; }
  GapScreen* mutable_screen() { return &*screen_; }
  const GapRows& rows() const { return data_->rows(); }
  GapData* data() const { return data_.get(); }
  const GapData* reference() const { return reference_.get(); }  // or null
  // Whether it is more than one log, so that it tells how logs differ.
  bool has_several_references() const;
  // What the reference's logs differ by, pooled over joints; of no logs where
  // there is none.
  ReferenceScatter ScatterOf(const GapCandidate& effect) const;
  // How much of an effect the reference has as well, given what `all` effects
  // (this one among them) give in the diagnosed logs, per joint thinned
  // samples; none, told by nothing, where there is no reference.
  ShareOfEffect ShareInReference(const GapCandidate& effect,
                                 const JointRows& all) const;
  // Whether a law that acts backwards, as less of it than the reference had
  // does, can be that: one that cannot act backwards by itself (a spring) has
  // to be there before it is lost. True for all others.
  bool CouldHaveLost(const GapCandidate& effect,
                     const std::vector<GapCandidate>& all) const;
  // The baseline's values before these logs: the file's, or those of the
  // reference.
  const Eigen::VectorXd& before() const { return before_; }
  // The covariance of these as the reference alone gives it, of the model's own
  // columns; 0 where there is no reference.
  Eigen::MatrixXd CovarianceBefore() const;
  // Its values without any effect.
  const Eigen::VectorXd& refit() const { return refit_; }
  // Per joint thinned samples, N m or N.
  JointRows TorqueOf(const std::vector<GapCandidate>& effects) const;
  // The baseline's values given such a torque.
  Eigen::VectorXd BaselineGiven(const JointRows& torque) const;
  // The same of the model alone, 0 for what models lack as a rule.
  Eigen::VectorXd ModelGiven(const JointRows& torque) const;

 private:
  void EstimateNoise();
  void DistrustOtherMotion(GapData* data) const;
  void SettleReference();
  void WeighReference();
  double LikeliestDiscrepancy(const GapScreen& screen,
                              const EvidenceNoise& noise) const;
  void MakeScreen();
  bool HoldDays();
  bool HoldOffsets();
  bool HoldZeros();
  bool HoldNow(int column);

  const GapBaseline& baseline_;
  std::unique_ptr<GapData> data_;
  std::shared_ptr<GapData> reference_;  // the same for any part
  GapNoise noise_;
  EvidenceNoise evidence_;
  MotionScale scale_;
  double discrepancy_ = 1;  // of the routine size
  bool discrepancy_chosen_ = false;
  std::optional<GapScreen> screen_;
  // Whether friction is that of another day than the reference's, and the
  // columns of it that are held nevertheless.
  std::optional<bool> another_day_;
  std::set<int> held_;
  std::set<int> changed_together_;  // of the days' columns
  bool holds_zeros_ = false;
  Eigen::VectorXd before_, refit_;
};

}  // namespace armcal

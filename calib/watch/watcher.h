#pragma once

#include <deque>
#include <functional>
#include <optional>
#include <vector>

#include "calib/numerics/triangular_factor.h"
#include "calib/watch/causal_rows.h"
#include "calib/watch/event.h"
#include "calib/watch/null_model.h"

namespace armcal {

struct WatcherOptions {
  double bandwidth_hz = 20;  // of the equations' low pass
  double learn_s = 30;       // what is normal is learned from, at first
  // Over which parameters may wander by what they seem to: the estimate of what
  // they are "before" a change is of about so much of the past.
  double memory_s = 120;
  double false_alarms_per_hour = .1;
};

// Follows a log sample by sample in bounded memory, and tells events.
//   Fast: the momentum observer's residual of each joint against its limit: a
//   contact. Slow: blocks of rows of the last 16 s; at each block's end the
//   Bayes factors of payload, each joint's friction and a lasting wrench for
//   changes that began 1, 2, 4 .. blocks ago (window-limited generalised
//   likelihood ratios: Lai 1998), against the parameters that older rows tell.
class Watcher {
 public:
  using Events = std::function<void(const WatchEvent&)>;
  Watcher(WatchModel model, const WatcherOptions& options, Events events);

  // Times rise. A hole in them restarts the filters, and is told.
  void Add(double t, const Eigen::VectorXd& q, const Eigen::VectorXd& tau);
  // At the end of a log that was shorter than what is to be learned from.
  bool learning() const { return !null_.has_value(); }

  WatchState State() const;
  double delay() const { return rows_.delay(); }
  // Without forgetting: all rows but those of contacts, least squares, each
  // joint's equations over its residual in the calibration; [A | r] as
  // A (x - calibrated x) = r.
  const TriangularFactor& whole_log() const { return whole_log_; }
  // That estimate and its standard deviations, which hold that successive rows
  // are alike. Directions that the log does not show stay as calibrated.
  std::vector<WatchedValue> WholeLogEstimate() const;
  const WatchModel& model() const { return model_; }
  // Sees every row that goes into whole_log().
  std::function<void(const Eigen::MatrixXd& A, const Eigen::VectorXd& r)> sink;

 private:
  // A change that was told and lasts: what was known before, and all since.
  struct Lasting {
    size_t hypothesis;
    double onset;
    ParameterBelief before;
    Eigen::MatrixXd root;
    RowInformation since;
  };

  Eigen::VectorXd SlowTorque() const;
  WatchRow MakeRow(double t) const;
  void Keep(const WatchRow& row);
  void Learn(const WatchRow& row);
  void EndLearning(double t);
  void CompareWithCalibration(const RowInformation& all, double t);
  void CheckResidual(double t);
  void BeginContact(double t);
  void EndContact(double t);
  void EndBlock(double t);
  void Decide(double t);
  void DecideBetween(double t, double onset,
                     const std::vector<ChangeEvidence>& evidence);
  void Tell(double t, double onset, size_t hypothesis,
            const ChangeEvidence& evidence);
  void TellUndecided(double t, double onset);
  void Accept(size_t hypothesis, double onset);
  void Fold(size_t blocks);
  void SetBelief(const ParameterBelief& belief);
  double PeakRatio() const;
  std::vector<WatchedValue> ValuesOf(size_t hypothesis,
                                     const ChangeEvidence& evidence) const;

  WatchModel model_;
  WatcherOptions options_;
  Events events_;
  CausalRows rows_;
  std::vector<WatchHypothesis> hypotheses_;
  NullOptions null_options_;
  double first_ = 0, last_ = -1, last_row_ = -1;
  double step_ = 0;  // of the samples, s, slowly averaged

  std::vector<WatchRow> learning_rows_;
  double learned_s_ = 0;
  std::optional<NullModel> null_;
  ParameterBelief belief_;  // before the blocks
  Eigen::MatrixXd root_;    // of its covariance and the wander
  std::deque<RowInformation> blocks_;
  RowInformation block_;
  std::vector<Lasting> lasting_;

  Eigen::VectorXd residual_, stddev_, limit_, parameter_variance_;
  double quiet_since_ = 0;
  bool contact_ = false, slow_contact_ = false, undecided_told_ = false;
  double contact_onset_ = 0, unclear_since_ = -1;
  double settled_ = 0, learn_soon_until_ = 0;
  double peak_ = 0, peak_torque_ = 0;  // in limits, and in N m or N
  int peak_joint_ = 0;

  TriangularFactor whole_log_;
};

}  // namespace armcal

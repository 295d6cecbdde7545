#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "calib/diagnose/data/segment.h"
#include "calib/logs/torque_drift.h"
#include "calib/numerics/autoregression.h"

namespace armcal {

// Which samples of a log have rows. Where no log is held out, each third block
// of every segment is of one of three folds, each of which is predicted by a
// fit to the other two (cross-validation: Stone 1974). Blocks are tenths of a
// segment, with guards at the edges of those that are predicted; of segments
// whose tenths are shorter than guards and the shortest run they are sevenths,
// fourths or thirds, and those too short for three are in no fold.
struct LogPart {
  enum class Rows { kAll, kFold, kOtherFolds, kAnyFold };

  static constexpr int kFolds = 3;
  static LogPart Fold(int fold) { return {Rows::kFold, fold}; }
  // All but a fold and, since its edges are guarded, nothing between.
  static LogPart OtherFolds(int fold) { return {Rows::kOtherFolds, fold}; }
  // What any fold holds.
  static LogPart AnyFold() { return {Rows::kAnyFold, 0}; }

  Rows rows = Rows::kAll;
  int fold = 0;
};

// Rows of a regression on the torque of some logs: signals are low-passed at
// the bandwidth, thinned to 2.5 times it, and whitened by each joint's noise.
// Samples of which a joint stands still, and the ends that filters bend, have
// no row.
class GapRows {
 public:
  // That filters bend at an end of a segment, of the bandwidth.
  static constexpr double kPeriodsAtEnds = 4;

  // References to segments are kept.
  GapRows(const std::vector<GapSegment>& segments, double bandwidth_hz,
          LogPart part = {});

  // The shortest segment that has rows, s: one run between the ends that
  // filters bend.
  static double Shortest(double bandwidth_hz);
  // The shortest segment of which a part can be held out, s.
  static double ShortestSplit(double bandwidth_hz);

  int num_joints() const { return static_cast<int>(runs_.size()); }
  double bandwidth_hz() const { return bandwidth_hz_; }
  LogPart part() const { return part_; }
  const std::vector<GapSegment>& segments() const { return segments_; }
  double step(int segment) const;  // s, between thinned samples
  double time() const;             // s, of all thinned samples
  // Thinned samples of all segments, one below the other.
  int num_thin() const { return thin_begin_.back(); }
  int thin_begin(int segment) const { return thin_begin_[segment]; }
  int SegmentOf(int thin) const;
  double thin_time(int segment, int k) const;  // s since the log's first row

  // A fine signal (samples x any) of a segment, low-passed and thinned.
  Eigen::MatrixXd Thin(int segment, const Eigen::MatrixXd& signal) const;
  // The same of signals in columns wherever they lie.
  Eigen::MatrixXd Thin(
      int segment, const std::vector<const Eigen::VectorXd*>& signals) const;
  // The same without the low pass.
  Eigen::MatrixXd Pick(int segment, const Eigen::MatrixXd& signal) const;

  // A fine signal of each segment likewise, one below the other.
  Eigen::MatrixXd ThinAll(const std::vector<Eigen::MatrixXd>& signals) const;
  Eigen::MatrixXd PickAll(const std::vector<Eigen::MatrixXd>& signals) const;

  // Whether a thinned sample is of the part of its segment that has rows, where
  // joints move.
  bool IsInPart(int segment, int k) const;
  // Whether a joint does not slide there, so that its friction is not known:
  // it rests, or breaks away from a rest.
  bool IsHeld(int segment, int joint, int k) const;

  // Uninterrupted thinned samples, [begin, begin + size) of all, of a segment.
  struct Run {
    int segment;
    int begin;
    int size;
  };
  const std::vector<Run>& runs(int joint) const { return runs_[joint]; }
  // The same where the joint stands still.
  const std::vector<Run>& still_runs(int joint) const {
    return still_runs_[joint];
  }

  // `extra_stddev`: standard deviation of what else may be wrong with single
  // samples (thinned samples x n, N m or N); rows count the less.
  void SetNoise(std::vector<Autoregression> noise,
                const Eigen::MatrixXd& extra_stddev);
  // From now on Whiten() takes what the model leaves for white noise of these
  // standard deviations (n, N m or N), not for the noise of the torque alone:
  // what is right of the model is told by what it leaves, samples of which are
  // not all independent.
  void SetEvidence(const Eigen::VectorXd& stddev,
                   const Eigen::MatrixXd& extra_stddev);
  // Times the standard deviations, extra ones included.
  void ScaleEvidence(const Eigen::VectorXd& factor);
  bool has_evidence() const { return evidence_.size() > 0; }
  const Eigen::VectorXd& evidence() const { return evidence_; }
  const Autoregression& noise(int joint) const { return noise_[joint]; }
  // Variance of a thinned sample: of the noise, and the extra one.
  double variance(int joint, int sample) const {
    return variance_(sample, joint);
  }
  int num_rows(int joint) const;
  int num_rows() const;
  // A joint's thinned signals (num_thin() x any) without what the torque's
  // level may do in logs whose torque drifts, told where the joint moves; rows
  // that are not known (NaN) stay so.
  Eigen::MatrixXd WithoutDrift(int joint, const Eigen::MatrixXd& thin) const;
  // Whitened rows of thinned signals (num_thin() x any).
  Eigen::MatrixXd Whiten(int joint, const Eigen::MatrixXd& thin) const;
  // The same by the noise of the torque alone.
  Eigen::MatrixXd WhitenByNoise(int joint, const Eigen::MatrixXd& thin) const;
  // The thinned sample that each row is of.
  std::vector<int> SampleOfRow(int joint) const;
  // The same with its segment and its time, s since the log's first row.
  struct Place {
    int sample;
    int segment;
    double time;
  };
  std::vector<Place> PlacesOfRows(int joint) const;

 private:
  // Thin() or Pick() of each segment, one below the other.
  using OfSegment = Eigen::MatrixXd (GapRows::*)(int,
                                                 const Eigen::MatrixXd&) const;
  Eigen::MatrixXd Stacked(const std::vector<Eigen::MatrixXd>& signals,
                          OfSegment part) const;
  enum class Use { kMoving, kStill, kNone };
  void MakeRuns();
  // Rows of each run, its first kOrder samples left out, times their weights.
  template <typename Rows>
  Eigen::MatrixXd RowsOfRuns(int joint, const Eigen::MatrixXd& thin,
                             const Eigen::MatrixXd& weight,
                             Rows rows_of_run) const;
  Use UseOf(int segment, int joint, int k) const;

  const std::vector<GapSegment>& segments_;
  double bandwidth_hz_;
  LogPart part_;
  std::vector<int> stride_;                        // per segment
  std::vector<int> skip_;                          // fine samples at its ends
  std::vector<int> thin_begin_;                    // per segment, and the end
  std::vector<int> blocks_;                        // per segment, for LogPart
  std::vector<std::optional<TorqueDrift>> drift_;  // per segment
  Eigen::VectorXd reconstructed_stddev_;           // per joint, N m or N
  std::vector<std::vector<Run>> runs_, still_runs_;
  std::vector<Autoregression> noise_;
  Eigen::MatrixXd variance_, weight_;  // thinned samples x n
  Eigen::VectorXd evidence_;           // n, N m or N; empty: none
  Eigen::MatrixXd evidence_weight_;    // like weight_
};

}  // namespace armcal

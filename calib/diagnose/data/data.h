#pragma once

#include <Eigen/Core>
#include <map>
#include <memory>
#include <vector>

#include "calib/diagnose/data/baseline.h"
#include "calib/diagnose/data/noise.h"
#include "calib/diagnose/data/rows.h"
#include "calib/diagnose/data/screen.h"
#include "calib/diagnose/data/segment.h"

namespace armcal {

// Logs made ready for a diagnosis: motion, torque of the robot as its file has
// it, what is left of the recorded torque, and the baseline's columns.
class GapData {
 public:
  // `segments` are kept. `usual_torque`: n entries, N m or N.
  GapData(std::vector<GapSegment> segments, const GapBaseline& baseline,
          double bandwidth_hz, LogPart part = {});
  // The same logs, other rows of them, with what is held, scaled and masked
  // there; shares what does not differ.
  GapData(const GapData& other, LogPart part);
  GapData(const GapData&) = delete;
  GapData& operator=(const GapData&) = delete;

  const GapRows& rows() const { return *rows_; }
  std::vector<RecordedTorque>* mutable_torques() { return &torques_; }
  const std::vector<RecordedTorque>& torques() const { return torques_; }
  // Recorded minus nominal torque, thinned samples x n, N m or N.
  const Eigen::MatrixXd& residual() const { return signals_->residual; }
  // The same on the segments' own grids.
  std::vector<Eigen::MatrixXd> FineResidual() const;
  // Per joint, of thinned samples.
  const std::vector<BaselineColumns>& columns() const { return *columns_; }
  // What the baseline at x leaves.
  Eigen::MatrixXd ResidualWith(const Eigen::VectorXd& x) const;
  // The same given a torque: per joint thinned samples, empty where it is 0.
  Eigen::MatrixXd ResidualWith(
      const Eigen::VectorXd& x,
      const std::vector<Eigen::VectorXd>& torque) const;

  // From now on a delay moves what the baseline at x has of friction, too.
  void MoveFrictionByDelays(const GapBaseline& baseline,
                            const Eigen::VectorXd& x);
  // Friction near zero velocity has an extra variance beyond what the
  // baseline's columns can vary: laws differ, and encoders do not see slow
  // creep.
  void SetNoise(std::vector<Autoregression> noise);
  // Rows are from now on whitened as GapRows::SetEvidence says.
  void SetEvidence(const Eigen::VectorXd& stddev);
  void ScaleEvidence(const Eigen::VectorXd& factor);
  // Multiplies the baseline's columns from `first` on.
  void ScaleColumns(int first, double factor);
  // As if this column of the baseline did not act in these logs; and as if it
  // had not been held, but for what was scaled since then.
  void Hold(int column);
  void Free(int column);
  // From now on samples may be off by this as well (standard deviations,
  // thinned samples x n, N m or N), whatever is masked; with the next noise.
  void Distrust(const Eigen::MatrixXd& extra_stddev);
  // From now on nothing is believed of a log in this time, s.
  void Mask(int log, const TimeRange& window);
  // All is believed again.
  void Unmask();
  // Of each thinned sample, whether nothing is believed of it.
  std::vector<bool> Masked() const;
  // Whitened, per joint.
  std::vector<BaselineColumns> WhitenedColumns() const;
  std::vector<Eigen::VectorXd> WhitenedResidual() const;
  // The residual on these columns, the baseline's first `columns` alone.
  GapScreen Screen(int columns) const;
  GapScreen Screen() const { return Screen(num_columns_); }

 private:
  using Columns = std::vector<BaselineColumns>;
  // What does not depend on which samples have rows.
  struct Signals {
    std::vector<GapSegment> segments;
    Eigen::MatrixXd residual;
    Eigen::MatrixXd usual_extra_stddev;
  };

  void MaskIn(int segment, const TimeRange& window,
              Eigen::MatrixXd* extra_stddev) const;

  std::shared_ptr<Signals> signals_;  // of all parts
  std::unique_ptr<GapRows> rows_;
  std::vector<RecordedTorque> torques_;
  std::shared_ptr<const Columns> columns_;
  // Per joint that a held column acts on.
  std::map<int, std::map<int, Eigen::VectorXd>> held_;
  int num_columns_;
  ColumnPrior prior_;
  Eigen::MatrixXd extra_stddev_;
};

}  // namespace armcal

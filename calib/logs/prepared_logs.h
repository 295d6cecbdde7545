#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "calib/logs/log_set.h"
#include "model/signals/trajectory.h"

namespace armcal {

struct KeptTrajectories;  // prepared_logs.cc

// Gross errors in torque samples, a list per log in the order of rows.
using OutlierLists = std::vector<std::vector<TorqueOutlier>>;

// How trajectories are made of recorded logs.
struct PreparationOptions {
  // Cutoff of the zero-phase low pass on positions, Hz; 0: data as they are.
  double bandwidth_hz = 0;
  double reach_s = 0;  // how far rows reach beyond the sample they belong to
  // Whether spikes of the torque (spikes.h) are replaced, where no outliers
  // are listed.
  bool remove_spikes = true;
  double longest_gap_s = 0;  // as in TrajectoryOptions
  // Whether friction's own motion (friction_bandwidth.h) is followed as well.
  bool friction_motion = true;
  // These torque samples are replaced, and none but these.
  std::optional<OutlierLists> outliers;
};

// Logs as they are prepared for passes: a view that nothing changes, whose
// copies share the trajectories that a pass has made. One pass at a time is
// made over a set of logs; another thread's waits.
class PreparedLogs {
 public:
  using Visit = std::function<void(int log, const Trajectory&)>;

  const LogSet& logs() const { return logs_; }
  int size() const { return logs_.size(); }
  const std::vector<TimeBase>& time_bases() const { return logs_.time_bases(); }
  const PreparationOptions& options() const { return options_; }
  // As FrictionBandwidth has it; none for data as they are.
  const std::optional<FrictionBand>& friction() const { return friction_; }

  // Calls visit(log, trajectory) for all of them, in order.
  void ForEach(const std::string& stage, const Progress& progress,
               const Visit& visit) const;
  // Neither thinned nor rid of outliers, the torque also sample by sample.
  void ForEachAtFullRate(const std::string& stage, const Progress& progress,
                         const Visit& visit) const;
  // Spikes of all joints that ForEach replaces; known after one.
  long spikes() const;
  // Samples of each joint's position that are left out as spikes
  // (position_spikes.h); known after one, empty of data as they are.
  const Eigen::Array<long, 1, Eigen::Dynamic>& position_spikes() const;

 private:
  friend PreparedLogs Prepare(const LogSet& logs,
                              const PreparationOptions& options);

  PreparedLogs(const LogSet& logs, const PreparationOptions& options);
  void VisitStretches(const Visit& visit, int log,
                      Trajectory* trajectory) const;

  LogSet logs_;
  PreparationOptions options_;
  std::optional<FrictionBand> friction_;
  std::shared_ptr<KeptTrajectories> kept_;
};

// What was made for the last preparation of these logs serves again where the
// options are the same.
PreparedLogs Prepare(const LogSet& logs, const PreparationOptions& options);

}  // namespace armcal

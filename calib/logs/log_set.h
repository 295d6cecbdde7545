#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "model/log_files/kept_log.h"
#include "model/signals/trajectory.h"
#include "model/text/kept_items.h"

namespace armcal {

// Told what is being done and how far it is, 0 to 1; below 0: nobody knows.
using Progress = std::function<void(const std::string& stage, double fraction)>;
// Gross errors in torque samples, a list per log in the order of rows.
using OutlierLists = std::vector<std::vector<TorqueOutlier>>;

// Several logs that are worked through together, pass after pass. What a pass
// has read and made of them is kept for the next as far as the memory allowed
// for goes; beyond it passes read and make it again, in memory that does not
// grow with the logs, with the same results.
class LogSet {
 public:
  using Visit = std::function<void(int log, const Trajectory&)>;

  // Opens the logs and audits their time bases. Throws InputError.
  LogSet(const std::vector<std::string>& paths,
         const LogReaderOptions& log_options, const TimeRange& crop,
         std::size_t memory_bytes = MemoryBudget::DefaultBytes());

  int size() const { return static_cast<int>(paths_.size()); }
  const std::string& path(int log) const { return paths_[log]; }
  const std::vector<TimeBase>& time_bases() const { return time_bases_; }
  const std::string& torque_source() const { return torque_source_; }
  // What a log has instead of recorded torques; null where it has these.
  const MadeTorque* made_torque(int log) const { return made_[log].get(); }

  // Sets how trajectories are made; before ForEach. Spikes of the torque are
  // replaced or kept, and no outliers are known. Longest gap as in
  // TrajectoryOptions.
  void Prepare(double bandwidth_hz, double reach_s, bool remove_spikes = true,
               double longest_gap_s = 0);
  double bandwidth_hz() const { return options_.bandwidth_hz; }
  // From now on these torque samples are replaced, and none but these.
  void TakeOut(OutlierLists outliers);
  const OutlierLists& outliers() const { return outliers_; }

  // From now on only these stretches of each log count, s since its first row,
  // each without its end; what lies around them still feeds filters.
  using Stretches = std::vector<std::vector<TimeRange>>;
  void Keep(Stretches kept) { kept_ = std::move(kept); }

  // Calls visit(log, trajectory) for all of them, in order.
  void ForEach(const std::string& stage, const Progress& progress,
               const Visit& visit);
  // Neither thinned nor rid of outliers, the torque also sample by sample.
  void ForEachAtFullRate(const std::string& stage, const Progress& progress,
                         const Visit& visit);
  // Spikes of all joints that the last ForEach replaced.
  long spikes() const { return spikes_; }
  // What passes may keep what they made in.
  const std::shared_ptr<MemoryBudget>& memory() const { return memory_; }

 private:
  struct Stretch {
    int log;
    Trajectory trajectory;
    double progress;  // once it has been seen, 0 to 1
  };
  void WorkThrough(const std::string& stage, const Progress& progress,
                   TrajectoryOptions options, const OutlierLists& outliers,
                   KeptItems<Stretch>* kept, const Visit& visit);
  void Make(TrajectoryOptions options, const OutlierLists& outliers,
            const std::function<void(Stretch*)>& add);
  // The log, with recorded rates if they are wanted.
  KeptLog* Rows(int log, bool rates);
  void VisitKept(const Visit& visit, int log, Trajectory* trajectory) const;

  std::shared_ptr<MemoryBudget> memory_;
  std::vector<std::string> paths_;
  std::vector<KeptLog> logs_;
  KeptItems<Stretch> prepared_;
  TrajectoryOptions options_;
  std::vector<TimeBase> time_bases_;
  std::string torque_source_;
  std::vector<std::shared_ptr<const MadeTorque>> made_;
  Stretches kept_;  // empty: all
  OutlierLists outliers_;
  long spikes_ = 0;
};

}  // namespace armcal

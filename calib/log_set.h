#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "model/log_reader.h"
#include "model/trajectory.h"

namespace armcal {

// Told what is being done and how far it is, 0 to 1.
using Progress = std::function<void(const std::string& stage, double fraction)>;

// Several logs that are worked through together, pass after pass, without ever
// being in memory as a whole.
class LogSet {
 public:
  // Opens the logs and audits their time bases. Throws InputError.
  LogSet(const std::vector<std::string>& paths,
         const LogReaderOptions& log_options, const TimeRange& crop);

  int size() const { return static_cast<int>(paths_.size()); }
  const std::string& path(int log) const { return paths_[log]; }
  const std::vector<TimeBase>& time_bases() const { return time_bases_; }
  const std::string& torque_source() const { return torque_source_; }

  // Sets how trajectories are made; before ForEach.
  void Prepare(double bandwidth_hz, double reach_s);
  double bandwidth_hz() const { return options_.bandwidth_hz; }
  // Calls visit(log, trajectory) for all of them, in order.
  void ForEach(const std::string& stage, const Progress& progress,
               const std::function<void(int, const Trajectory&)>& visit);

 private:
  std::vector<std::string> paths_;
  LogReaderOptions log_options_;
  TrajectoryOptions options_;
  std::vector<TimeBase> time_bases_;
  std::string torque_source_;
};

}  // namespace armcal

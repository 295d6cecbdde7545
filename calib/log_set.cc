#include "calib/log_set.h"

#include "model/time_base.h"

namespace armcal {

LogSet::LogSet(const std::vector<std::string>& paths,
               const LogReaderOptions& log_options, const TimeRange& crop)
    : paths_(paths), log_options_(log_options) {
  options_.crop = crop;
  for (const std::string& path : paths) {
    LogReader reader(path, log_options);
    time_bases_.push_back(AuditTimeBase(path, crop, &reader));
    torque_source_ = reader.torque_source();
  }
}

void LogSet::Prepare(double bandwidth_hz, double reach_s) {
  options_.bandwidth_hz = bandwidth_hz;
  options_.reach_s = reach_s;
}

void LogSet::ForEach(const std::string& stage, const Progress& progress,
                     const std::function<void(int, const Trajectory&)>& visit) {
  Trajectory trajectory;
  for (int log = 0; log < size(); ++log) {
    TrajectoryReader reader(paths_[log], log_options_, time_bases_[log],
                            options_);
    while (reader.Next(&trajectory)) {
      visit(log, trajectory);
      if (progress) progress(stage, (log + reader.progress()) / size());
    }
  }
  if (progress) progress(stage, 1);
}

}  // namespace armcal

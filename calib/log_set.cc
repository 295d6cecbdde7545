#include "calib/log_set.h"

#include <algorithm>
#include <cmath>

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

void LogSet::Prepare(double bandwidth_hz, double reach_s, bool remove_spikes,
                     double longest_gap_s) {
  options_.longest_gap_s = longest_gap_s;
  options_.bandwidth_hz = bandwidth_hz;
  options_.reach_s = reach_s;
  options_.remove_spikes = remove_spikes;
  outliers_.clear();
}

void LogSet::ForEach(const std::string& stage, const Progress& progress,
                     const Visit& visit) {
  spikes_ = 0;
  WorkThrough(stage, progress, options_, outliers_, visit);
}

void LogSet::ForEachAtFullRate(const std::string& stage,
                               const Progress& progress, const Visit& visit) {
  TrajectoryOptions options = options_;
  options.every_sample = true;
  options.remove_spikes = false;
  WorkThrough(stage, progress, options, {}, visit);
}

void LogSet::WorkThrough(const std::string& stage, const Progress& progress,
                         TrajectoryOptions options,
                         const OutlierLists& outliers, const Visit& visit) {
  Trajectory trajectory;
  for (int log = 0; log < size(); ++log) {
    if (!outliers.empty()) options.outliers = &outliers[log];
    TrajectoryReader reader(paths_[log], log_options_, time_bases_[log],
                            options);
    while (reader.Next(&trajectory)) {
      spikes_ += trajectory.spikes.sum();
      VisitKept(visit, log, &trajectory);
      if (progress) progress(stage, (log + reader.progress()) / size());
    }
  }
  if (progress) progress(stage, 1);
}

void LogSet::VisitKept(const Visit& visit, int log,
                       Trajectory* trajectory) const {
  if (kept_.empty()) {
    visit(log, *trajectory);
    return;
  }
  const int begin = trajectory->core_begin, end = trajectory->core_end;
  const auto row_at = [&](double time) {
    const double row =
        std::ceil((time - trajectory->t0) / trajectory->dt - 1e-6);
    return static_cast<int>(std::clamp<double>(row, begin, end));
  };
  // What is between two of them is a gap.
  const int segment = trajectory->segment;
  const int count = static_cast<int>(kept_[log].size());
  for (int k = 0; k < count; ++k) {
    const TimeRange& range = kept_[log][k];
    trajectory->segment = segment * count + k;
    trajectory->core_begin = row_at(range.begin);
    trajectory->core_end = row_at(range.end);
    if (trajectory->core_begin < trajectory->core_end) visit(log, *trajectory);
  }
}

}  // namespace armcal

#include "calib/logs/log_set.h"

#include <tbb/task_group.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "model/log_files/time_base.h"

namespace armcal {
LogSet::LogSet(const std::vector<std::string>& paths,
               const LogReaderOptions& log_options, const TimeRange& crop,
               std::size_t memory_bytes)
    : memory_(std::make_shared<MemoryBudget>(memory_bytes)),
      paths_(paths),
      prepared_(memory_) {
  options_.crop = crop;
  for (const std::string& path : paths) {
    logs_.emplace_back(path, log_options, memory_);
    time_bases_.push_back(AuditTimeBase(crop, &logs_.back()));
    torque_source_ = logs_.back().torque_source();
    const auto made = log_options.made_torque.find(path);
    made_.push_back(made == log_options.made_torque.end() ? nullptr
                                                          : made->second);
  }
}

void LogSet::Prepare(double bandwidth_hz, double reach_s, bool remove_spikes,
                     double longest_gap_s) {
  options_.longest_gap_s = longest_gap_s;
  options_.bandwidth_hz = bandwidth_hz;
  options_.reach_s = reach_s;
  options_.remove_spikes = remove_spikes;
  outliers_.clear();
  prepared_.Forget();
}

void LogSet::TakeOut(OutlierLists outliers) {
  const auto none = [](const OutlierLists& lists) {
    return std::all_of(lists.begin(), lists.end(),
                       [](const auto& list) { return list.empty(); });
  };
  // Where no sample was replaced, and none is to be, nothing changes.
  const bool as_recorded = spikes_ == 0 && none(outliers_) && none(outliers);
  if (!prepared_.whole() || !as_recorded) prepared_.Forget();
  outliers_ = std::move(outliers);
}

void LogSet::ForEach(const std::string& stage, const Progress& progress,
                     const Visit& visit) {
  spikes_ = 0;
  WorkThrough(stage, progress, options_, outliers_, &prepared_, visit);
}

void LogSet::ForEachAtFullRate(const std::string& stage,
                               const Progress& progress, const Visit& visit) {
  TrajectoryOptions options = options_;
  options.every_sample = true;
  options.remove_spikes = false;
  WorkThrough(stage, progress, options, {}, nullptr, visit);
}

void LogSet::WorkThrough(const std::string& stage, const Progress& progress,
                         TrajectoryOptions options,
                         const OutlierLists& outliers, KeptItems<Stretch>* kept,
                         const Visit& visit) {
  const auto see = [&](Stretch* stretch) {
    spikes_ += stretch->trajectory.spikes.sum();
    VisitKept(visit, stretch->log, &stretch->trajectory);
    if (progress) progress(stage, stretch->progress);
  };
  if (kept != nullptr && kept->whole()) {
    for (Stretch& stretch : kept->items()) see(&stretch);
  } else {
    if (kept != nullptr) kept->Begin();
    Make(options, outliers, [&](Stretch* stretch) {
      see(stretch);
      if (kept != nullptr) {
        kept->Add(stretch, sizeof(Stretch) + BytesOf(stretch->trajectory));
      }
    });
    if (kept != nullptr) kept->End();
  }
  if (progress) progress(stage, 1);
}

void LogSet::Make(TrajectoryOptions options, const OutlierLists& outliers,
                  const std::function<void(Stretch*)>& add) {
  for (int log = 0; log < size(); ++log) {
    if (!outliers.empty()) options.outliers = &outliers[log];
    KeptLog* const rows = Rows(log, options.bandwidth_hz == 0);
    rows->Rewind();
    TrajectoryReader reader(rows, time_bases_[log], options);
    Stretch stretch, next;
    bool more = true;
    const auto make_next = [&] {
      more = reader.Next(&next.trajectory);
      next.log = log;
      next.progress = (log + reader.progress()) / size();
    };
    make_next();
    while (more) {
      std::swap(stretch, next);
      // While one is looked at another thread makes the next.
      tbb::task_group ahead;
      ahead.run(make_next);
      add(&stretch);
      ahead.wait();
    }
  }
}

KeptLog* LogSet::Rows(int log, bool rates) {
  LogReaderOptions options = logs_[log].options();
  if (rates && !options.want_velocity) {
    options.want_velocity = options.want_acceleration = true;
    logs_[log] = KeptLog(paths_[log], options, memory_);
  }
  return &logs_[log];
}

void LogSet::VisitKept(const Visit& visit, int log,
                       Trajectory* trajectory) const {
  if (kept_.empty()) {
    visit(log, *trajectory);
    return;
  }
  const int begin = trajectory->core_begin, end = trajectory->core_end;
  const int segment = trajectory->segment;
  const auto row_at = [&](double time) {
    const double row =
        std::ceil((time - trajectory->t0) / trajectory->dt - 1e-6);
    return static_cast<int>(std::clamp<double>(row, begin, end));
  };
  // What is between two of them is a gap.
  const int count = static_cast<int>(kept_[log].size());
  for (int k = 0; k < count; ++k) {
    const TimeRange& range = kept_[log][k];
    trajectory->segment = segment * count + k;
    trajectory->core_begin = row_at(range.begin);
    trajectory->core_end = row_at(range.end);
    if (trajectory->core_begin < trajectory->core_end) visit(log, *trajectory);
  }
  trajectory->segment = segment;
  trajectory->core_begin = begin;
  trajectory->core_end = end;
}

}  // namespace armcal

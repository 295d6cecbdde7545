#include "calib/logs/prepared_logs.h"

#include <tbb/task_group.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "calib/logs/friction_bandwidth.h"
#include "calib/logs/recorded_logs.h"
#include "model/signals/position_spikes.h"

namespace armcal {
namespace {

// A trajectory, and how far the logs have been seen with it, 0 to 1.
struct Stretch {
  int log;
  Trajectory trajectory;
  double progress;
};

bool AreNone(const std::optional<OutlierLists>& lists) {
  return !lists || std::all_of(lists->begin(), lists->end(),
                               [](const auto& list) { return list.empty(); });
}

bool AreSameBut(const PreparationOptions& a, const PreparationOptions& b) {
  return a.bandwidth_hz == b.bandwidth_hz && a.reach_s == b.reach_s &&
         a.longest_gap_s == b.longest_gap_s &&
         a.friction_motion == b.friction_motion;
}

}  // namespace

// What ForEach made, as far as the memory goes.
struct KeptTrajectories {
  KeptTrajectories(const PreparationOptions& options,
                   std::shared_ptr<MemoryBudget> memory)
      : made_with(options), stretches(std::move(memory)) {}

  // Whether trajectories with other options would be the same.
  bool Serves(const PreparationOptions& options) const {
    if (!AreSameBut(made_with, options)) return false;
    if (made_with.outliers == options.outliers) {
      return options.outliers ||
             made_with.remove_spikes == options.remove_spikes;
    }
    // Where no sample was replaced, and none is to be.
    return !made_with.outliers && options.outliers && stretches.whole() &&
           spikes == 0 && AreNone(options.outliers);
  }

  PreparationOptions made_with;
  KeptItems<Stretch> stretches;
  long spikes = 0;
  Eigen::Array<long, 1, Eigen::Dynamic> position_spikes;
};

PreparedLogs::PreparedLogs(const LogSet& logs,
                           const PreparationOptions& options)
    : logs_(logs), options_(options) {
  const double hz = options.bandwidth_hz;
  if (hz > 0 && options.friction_motion) {
    friction_ = FrictionBandwidth(MeasureEncoderNoise(logs, hz), hz);
  }
  RecordedLogs& recorded = *logs_.recorded_;
  const std::lock_guard<std::mutex> lock(recorded.pass);
  if (recorded.last == nullptr || !recorded.last->Serves(options)) {
    // Of several preparations one is kept; others are made again.
    if (recorded.last != nullptr) recorded.last->stretches.Forget();
    recorded.last =
        std::make_shared<KeptTrajectories>(options, recorded.memory);
  }
  kept_ = recorded.last;
}

PreparedLogs Prepare(const LogSet& logs, const PreparationOptions& options) {
  return PreparedLogs(logs, options);
}

long PreparedLogs::spikes() const { return kept_->spikes; }
const Eigen::Array<long, 1, Eigen::Dynamic>& PreparedLogs::position_spikes()
    const {
  return kept_->position_spikes;
}

namespace {

TrajectoryOptions OptionsOf(const PreparationOptions& prepared,
                            const std::optional<FrictionBand>& friction,
                            const TimeRange& crop) {
  TrajectoryOptions options;
  options.friction = friction;
  options.bandwidth_hz = prepared.bandwidth_hz;
  options.crop = crop;
  options.reach_s = prepared.reach_s;
  options.remove_spikes = prepared.remove_spikes;
  options.longest_gap_s = prepared.longest_gap_s;
  return options;
}

// Calls add(stretch) for all that the logs are made of, in order.
template <class Rows, class Add>
void Make(const Rows& rows_of, const std::vector<TimeBase>& time_bases,
          TrajectoryOptions options,
          const std::optional<OutlierLists>& outliers, const Add& add) {
  const int size = static_cast<int>(time_bases.size());
  for (int log = 0; log < size; ++log) {
    if (outliers) options.outliers = &(*outliers)[log];
    TrajectoryReader reader(rows_of(log), time_bases[log], options);
    Stretch stretch, next;
    bool more = true;
    const auto make_next = [&] {
      more = reader.Next(&next.trajectory);
      next.log = log;
      next.progress = (log + reader.progress()) / size;
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

}  // namespace

void PreparedLogs::ForEach(const std::string& stage, const Progress& progress,
                           const Visit& visit) const {
  RecordedLogs& recorded = *logs_.recorded_;
  const std::lock_guard<std::mutex> lock(recorded.pass);
  long spikes = 0;
  Eigen::Array<long, 1, Eigen::Dynamic> position_spikes;
  const auto see = [&](Stretch* stretch) {
    spikes += stretch->trajectory.spikes.sum();
    AddCounts(stretch->trajectory.position_spikes, &position_spikes);
    VisitStretches(visit, stretch->log, &stretch->trajectory);
    if (progress) progress(stage, stretch->progress);
  };
  KeptItems<Stretch>& kept = kept_->stretches;
  if (kept.whole()) {
    for (Stretch& stretch : kept.items()) see(&stretch);
  } else {
    kept.Begin();
    Make(
        [&](int log) { return recorded.Rows(log, options_.bandwidth_hz == 0); },
        recorded.time_bases, OptionsOf(options_, friction_, recorded.crop),
        options_.outliers,
        [&](Stretch* stretch) {
          see(stretch);
          kept.Add(stretch, sizeof(Stretch) + BytesOf(stretch->trajectory));
        });
    kept.End();
  }
  kept_->spikes = spikes;
  kept_->position_spikes = position_spikes;
  if (progress) progress(stage, 1);
}

void PreparedLogs::ForEachAtFullRate(const std::string& stage,
                                     const Progress& progress,
                                     const Visit& visit) const {
  RecordedLogs& recorded = *logs_.recorded_;
  const std::lock_guard<std::mutex> lock(recorded.pass);
  TrajectoryOptions options = OptionsOf(options_, friction_, recorded.crop);
  options.every_sample = true;
  options.remove_spikes = false;
  Make([&](int log) { return recorded.Rows(log, options_.bandwidth_hz == 0); },
       recorded.time_bases, options, std::nullopt,
       [&](Stretch* stretch) {
         VisitStretches(visit, stretch->log, &stretch->trajectory);
         if (progress) progress(stage, stretch->progress);
       });
  if (progress) progress(stage, 1);
}

void PreparedLogs::VisitStretches(const Visit& visit, int log,
                                  Trajectory* trajectory) const {
  const LogSet::Stretches& stretches = logs_.stretches();
  if (stretches.empty()) {
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
  const int count = static_cast<int>(stretches[log].size());
  for (int k = 0; k < count; ++k) {
    const TimeRange& range = stretches[log][k];
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

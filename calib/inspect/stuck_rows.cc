#include "calib/inspect/stuck_rows.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <iterator>
#include <utility>

#include "calib/diagnose/data/rows.h"
#include "calib/diagnose/data/segment.h"
#include "calib/inspect/frozen_findings.h"
#include "calib/inspect/inspected_series.h"
#include "calib/inspect/inspection.h"
#include "calib/logs/position_jumps.h"
#include "calib/logs/stamp_audit.h"
#include "model/log_files/log_reader.h"
#include "model/text/input_error.h"

namespace armcal {
namespace {

struct StuckRows {
  std::vector<RowRange> rows;
  std::vector<DataFinding> findings;
};

bool IsWithin(const TimeRange& crop, double begin, double end) {
  return end >= crop.begin && begin <= crop.end;
}

// Whether stretches without holes, each as long as a diagnosis needs it, have
// 2 s of motion together.
bool IsEnoughLeft(const Log& log, double step, const TimeRange& crop,
                  double bandwidth_hz) {
  const UniformSeries series = InspectedSeries(log, step);
  const double longest_gap = std::max(kGapPeriods / bandwidth_hz, 3 * step);
  const double needed = ShortestMotion(bandwidth_hz);
  double moving = 0;
  for (int begin = 0, end = 1; begin < log.size(); begin = end++) {
    while (end < log.size() && log.t[end] - log.t[end - 1] <= longest_gap) {
      ++end;
    }
    const TimeRange stretch{std::max(log.t[begin], crop.begin),
                            std::min(log.t[end - 1], crop.end)};
    if (stretch.end - stretch.begin < needed) continue;
    for (const int sample : series.moving()) {
      const double t = series.motion().time(sample);
      moving += stretch.Contains(t) ? series.dt() : 0;
    }
  }
  return moving >= kShortestSegment;
}

// Of a log as an inspection reads it. What cannot be read at all is refused
// where the log is opened for what it is wanted for, which says more.
StuckRows StuckRowsIn(const Robot& robot, const LogSource& source,
                      const TimeRange& crop,
                      const std::optional<double>& bandwidth_hz,
                      LogReaderOptions reading) {
  constexpr double kBandwidth = 10;  // Hz, as in DiagnosisBandwidth
  StuckRows stuck;
  Log log;
  try {
    reading.want_velocity = reading.commands_do = reading.currents_do = true;
    LogReader(source, reading).Read(kMostInspectedRows, &log);
  } catch (const InputError&) {
    return stuck;
  }
  if (log.size() < 3 || log.tau.size() == 0) return stuck;
  const StampFigures stamps = AuditStamps(log);
  if (!(stamps.mean_step > 0)) return stuck;
  log.t *= stamps.unit;
  MendJumps(FindPositionJumps(robot, log), &log);
  const std::vector<FrozenChannel> frozen =
      FindFrozenChannels(robot, log, InspectedSeries(log, stamps.mean_step));
  if (frozen.empty() ||
      !IsEnoughLeft(WithoutFrozenRows(log, frozen), stamps.mean_step, crop,
                    bandwidth_hz.value_or(
                        std::min(kBandwidth, .125 / stamps.mean_step)))) {
    return stuck;
  }
  stuck.rows = RowsOf(frozen);
  const auto findings = FrozenFindings(robot, log.t, frozen);
  for (size_t k = 0; k < frozen.size(); ++k) {
    if (!IsWithin(crop, log.t[frozen[k].begin], log.t[frozen[k].end - 1])) {
      continue;
    }
    stuck.findings.push_back(
        {"of " + source.name + " " + findings[k].sentence +
             ", and these rows are left out",
         findings[k].evidence,
         "what follows is of the log without them, of all joints", true});
  }
  return stuck;
}

}  // namespace

std::vector<DataFinding> LeaveOutStuckRows(
    const Robot& robot, const std::vector<LogSource>& logs,
    const TimeRange& crop, const std::optional<double>& bandwidth_hz,
    LogReaderOptions* reading) {
  std::vector<StuckRows> stuck(logs.size());
  tbb::parallel_for(size_t{0}, logs.size(), [&](size_t k) {
    stuck[k] = StuckRowsIn(robot, logs[k], crop, bandwidth_hz, *reading);
  });
  std::vector<DataFinding> findings;
  for (size_t k = 0; k < logs.size(); ++k) {
    if (stuck[k].rows.empty()) continue;
    reading->left_out[logs[k].name] = std::move(stuck[k].rows);
    std::move(stuck[k].findings.begin(), stuck[k].findings.end(),
              std::back_inserter(findings));
  }
  return findings;
}

}  // namespace armcal

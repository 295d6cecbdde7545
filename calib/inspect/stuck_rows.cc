#include "calib/inspect/stuck_rows.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <iterator>
#include <utility>

#include "calib/diagnose/data/segment.h"
#include "calib/diagnose/data/segments.h"
#include "calib/inspect/frozen_findings.h"
#include "calib/inspect/inspected_series.h"
#include "calib/inspect/inspection.h"
#include "calib/logs/log_set.h"
#include "calib/logs/position_jumps.h"
#include "calib/logs/stamp_audit.h"
#include "model/log_files/log_reader.h"
#include "model/signals/bandwidth.h"
#include "model/text/input_error.h"

namespace armcal {
namespace {

// A log once, and the parts of it that are used.
struct LogParts {
  LogSource log;
  std::vector<TimeRange> crops;
};

std::vector<LogParts> PartsOf(const std::vector<UsedLog>& used) {
  std::vector<LogParts> logs;
  for (const UsedLog& one : used) {
    const auto same = std::find_if(
        logs.begin(), logs.end(),
        [&](const LogParts& log) { return log.log.name == one.log.name; });
    if (same == logs.end()) {
      logs.push_back({one.log, {one.crop}});
    } else {
      same->crops.push_back(one.crop);
    }
  }
  return logs;
}

// Whether a diagnosis of this part of a log, read so, has 2 s of motion.
bool IsEnoughLeft(const LogSource& log, const TimeRange& crop,
                  const std::optional<double>& bandwidth_hz,
                  const LogReaderOptions& reading) {
  const LogSet left({log}, reading, crop);
  double moving = 0;
  for (const GapSegment& segment : ReadSegments(
           bandwidth_hz.value_or(DiagnosisBandwidth(left.time_bases())), {},
           left)) {
    moving += segment.motion.dt * static_cast<double>(segment.motion.size());
  }
  return moving >= kShortestSegment;
}

struct StuckRows {
  std::vector<RowRange> rows;
  std::vector<DataFinding> findings;
};

// Those that are in a used part lead a diagnosis.
std::vector<DataFinding> Told(const Robot& robot, const LogParts& parts,
                              const Log& log,
                              const std::vector<FrozenChannel>& frozen) {
  std::vector<DataFinding> told;
  const auto findings = FrozenFindings(robot, log.t, frozen);
  for (size_t k = 0; k < frozen.size(); ++k) {
    const double begin = log.t[frozen[k].begin], end = log.t[frozen[k].end - 1];
    if (std::none_of(parts.crops.begin(), parts.crops.end(),
                     [&](const TimeRange& crop) {
                       return end >= crop.begin && begin <= crop.end;
                     })) {
      continue;
    }
    told.push_back({"of " + parts.log.name + " " + findings[k].sentence +
                        ", and these rows are left out",
                    findings[k].evidence,
                    "what follows is of the log without them, of all joints",
                    true});
  }
  return told;
}

// Of a log as an inspection reads it. What cannot be read at all is refused
// where the log is opened for what it is wanted for, which says more.
StuckRows StuckRowsIn(const Robot& robot, const LogParts& parts,
                      const std::optional<double>& bandwidth_hz,
                      LogReaderOptions reading) {
  StuckRows stuck;
  try {
    LogReaderOptions inspected = reading;
    inspected.want_velocity = inspected.commands_do = inspected.currents_do =
        true;
    Log log;
    LogReader(parts.log, inspected).Read(kMostInspectedRows, &log);
    if (log.size() < 3 || log.tau.size() == 0) return stuck;
    const StampFigures stamps = AuditStamps(log);
    if (!(stamps.mean_step > 0)) return stuck;
    log.t *= stamps.unit;
    MendJumps(FindPositionJumps(robot, log), &log);
    const std::vector<FrozenChannel> frozen =
        FindFrozenChannels(robot, log, InspectedSeries(log, stamps.mean_step));
    if (frozen.empty()) return stuck;
    reading.left_out[parts.log.name] = RowsOf(frozen);
    for (const TimeRange& crop : parts.crops) {
      if (!IsEnoughLeft(parts.log, crop, bandwidth_hz, reading)) return stuck;
    }
    stuck = {RowsOf(frozen), Told(robot, parts, log, frozen)};
  } catch (const InputError&) {
    return {};
  }
  return stuck;
}

}  // namespace

std::vector<DataFinding> LeaveOutStuckRows(
    const Robot& robot, const std::vector<UsedLog>& used,
    const std::optional<double>& bandwidth_hz, LogReaderOptions* reading) {
  const std::vector<LogParts> logs = PartsOf(used);
  std::vector<StuckRows> stuck(logs.size());
  tbb::parallel_for(size_t{0}, logs.size(), [&](size_t k) {
    stuck[k] = StuckRowsIn(robot, logs[k], bandwidth_hz, *reading);
  });
  std::vector<DataFinding> findings;
  for (size_t k = 0; k < logs.size(); ++k) {
    if (stuck[k].rows.empty()) continue;
    reading->left_out[logs[k].log.name] = std::move(stuck[k].rows);
    std::move(stuck[k].findings.begin(), stuck[k].findings.end(),
              std::back_inserter(findings));
  }
  return findings;
}

}  // namespace armcal

#include "calib/inspect/stuck_rows.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <climits>
#include <functional>
#include <iterator>
#include <utility>

#include "calib/diagnose/data/segment.h"
#include "calib/diagnose/data/segments.h"
#include "calib/inspect/frozen_findings.h"
#include "calib/inspect/inspection.h"
#include "calib/inspect/jump_findings.h"
#include "calib/inspect/stuck_positions.h"
#include "calib/logs/log_set.h"
#include "calib/logs/position_jumps.h"
#include "calib/logs/stamp_audit.h"
#include "model/log_files/log_reader.h"
#include "model/log_files/text_source.h"
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

// Whether a diagnosis of this part of a log, read so, has 2 s of motion. What
// is too short to be read as a log has not.
bool IsEnoughLeft(const LogSource& log, const TimeRange& crop,
                  const std::optional<double>& bandwidth_hz,
                  const LogReaderOptions& reading) {
  try {
    const LogSet left({log}, reading, crop);
    double moving = 0;
    for (const GapSegment& segment : ReadSegments(
             bandwidth_hz.value_or(DiagnosisBandwidth(left.time_bases())), {},
             left)) {
      moving += segment.motion.dt * static_cast<double>(segment.motion.size());
    }
    return moving >= kShortestSegment;
  } catch (const ChangedFile&) {
    throw;
  } catch (const InputError&) {
    return false;
  }
}

// What is not read of a log, or otherwise, and what is to be said of it.
struct MendedLog {
  std::vector<PositionTurn> turns;
  std::vector<RowRange> rows;
  std::vector<DataFinding> findings;
  // Too little would be left without rows that are wrong: they stay.
  bool keeps_wrong_rows = false;
};

constexpr char kWrongRowsStay[] =
    ", and less than 2 s would be left without these rows, which stay";
constexpr char kNotTrusted[] =
    "nothing of such positions is to be trusted: record more of this motion, "
    "or leave this log out";

bool IsUsed(const LogParts& parts, double begin, double end) {
  return std::any_of(parts.crops.begin(), parts.crops.end(),
                     [&](const TimeRange& crop) {
                       return end >= crop.begin && begin <= crop.end;
                     });
}

// The rows of the used parts, t being their times; none where there are none.
std::vector<RowRange> UsedRows(const LogParts& parts,
                               const Eigen::VectorXd& t) {
  std::vector<RowRange> used;
  for (const TimeRange& crop : parts.crops) {
    const auto begin = std::lower_bound(t.begin(), t.end(), crop.begin);
    const auto end = std::upper_bound(begin, t.end(), crop.end);
    used.push_back({begin - t.begin(), end - t.begin()});
  }
  return used;
}

// Whether each used part that loses rows has kShortestSegment left of the time
// between rows that follow each other.
bool IsTimeLeft(const std::vector<RowRange>& used, const Eigen::VectorXd& t,
                const std::vector<RowRange>& left_out) {
  return std::all_of(used.begin(), used.end(), [&](const RowRange& part) {
    double left = 0;
    bool loses = false, before = false;
    for (long k = part.begin; k < part.end; ++k) {
      const bool now = !AnyContains(left_out, k);
      loses = loses || !now;
      if (before && now) left += t[k] - t[k - 1];
      before = now;
    }
    return !loses || left >= kShortestSegment;
  });
}

// Those that are in a used part lead a diagnosis.
std::vector<DataFinding> ToldOfFrozen(const Robot& robot, const LogParts& parts,
                                      const Log& log,
                                      const std::vector<FrozenChannel>& frozen,
                                      bool stay) {
  std::vector<DataFinding> told;
  const auto findings = FrozenFindings(robot, log.t, frozen);
  for (size_t k = 0; k < frozen.size(); ++k) {
    if (!IsUsed(parts, log.t[frozen[k].begin], log.t[frozen[k].end - 1])) {
      continue;
    }
    told.push_back(
        {"of " + parts.log.name + " " + findings[k].sentence +
             (stay ? kWrongRowsStay : ", and these rows are left out"),
         findings[k].evidence,
         stay ? kNotTrusted
              : "what follows is of the log without them, of all joints",
         true});
  }
  return told;
}

// Of wraps and lost zeros. These lead a diagnosis, since rows are lost with
// them; turns are none of the motion, and nothing is lost.
std::vector<DataFinding> ToldOfJumps(const Robot& robot, const LogParts& parts,
                                     const Log& log, LogJumps jumps,
                                     bool stay) {
  const auto is_unused = [&](const PositionJumps::Step& step) {
    return std::none_of(parts.crops.begin(), parts.crops.end(),
                        [&](const TimeRange& crop) {
                          return log.t[step.row - 1] >= crop.begin &&
                                 log.t[step.row] <= crop.end;
                        });
  };
  for (PositionJumps& of_joint : jumps.joints) {
    for (auto* steps : {&of_joint.wraps, &of_joint.steps}) {
      steps->erase(std::remove_if(steps->begin(), steps->end(), is_unused),
                   steps->end());
    }
  }
  std::vector<DataFinding> told;
  for (const InspectionFinding& found :
       JumpFindings(robot, log.t, jumps, true)) {
    const std::string sentence = "of " + parts.log.name + " " + found.sentence;
    if (found.finding == "position_wrap") {
      told.push_back({sentence + ", and these turns are taken out",
                      found.evidence, "log positions that go on"});
    } else if (found.finding == "position_jump") {
      told.push_back(
          {sentence + (stay ? kWrongRowsStay
                            : ", and the rows of its shorter side are left "
                              "out"),
           found.evidence,
           stay ? kNotTrusted
                : "what follows is of the log without them: its zero is "
                  "another one there",
           true});
    }
  }
  return told;
}

void AddTurns(const LogJumps& jumps, bool of_command,
              std::vector<PositionTurn>* turns) {
  for (size_t j = 0; j < jumps.joints.size(); ++j) {
    for (const PositionJumps::Step& wrap : jumps.joints[j].wraps) {
      turns->push_back({wrap.row, static_cast<int>(j), wrap.size, of_command});
    }
  }
}

// The channels of a log that are frozen, once its jumps are mended; mean_step,
// s, as its stamps have it.
using RowSearch = std::function<std::vector<FrozenChannel>(
    const Log& mended, const LogJumps& jumps, double mean_step)>;

// Mends jumps of a log whose time is in s.
MendedLog MendedOf(const Robot& robot, const LogParts& parts,
                   const RowSearch& find_frozen, double mean_step, Log log) {
  MendedLog mended;
  LogJumps jumps = FindPositionJumps(robot, log);
  AddTurns(jumps, false, &mended.turns);
  if (!mended.turns.empty() && log.qref.size() > 0) {
    Log commands;  // follow the encoder's turns, at rows of their own
    commands.t = log.t;
    commands.q = log.qref;
    AddTurns(FindPositionJumps(robot, commands), true, &mended.turns);
  }
  MendJumps(jumps, &log);
  AddZerosLostAtRest(robot, log, &jumps);
  const std::vector<FrozenChannel> frozen = find_frozen(log, jumps, mean_step);
  mended.rows = RowsOf(frozen);
  const std::vector<RowRange> used = UsedRows(parts, log.t);
  for (RowRange rows : RowsOfOtherZeros(jumps, log.size(), used)) {
    // More rows than are inspected are as the last of these.
    const bool is_cut = log.size() == kMostInspectedRows;
    if (is_cut && rows.end == log.size()) rows.end = LONG_MAX;
    mended.rows.push_back(rows);
  }
  const bool stay = !IsTimeLeft(used, log.t, mended.rows);
  mended.keeps_wrong_rows = stay;
  if (stay) mended.rows.clear();
  mended.findings = ToldOfFrozen(robot, parts, log, frozen, stay);
  const auto told = ToldOfJumps(robot, parts, log, jumps, stay);
  mended.findings.insert(mended.findings.end(), told.begin(), told.end());
  return mended;
}

// A log's parts in s, by what its stamps have to be multiplied by: a crop is in
// the log's own unit.
LogParts InSeconds(LogParts parts, double unit) {
  for (TimeRange& crop : parts.crops) {
    crop.begin *= unit;
    crop.end *= unit;
  }
  return parts;
}

// Of a log as an inspection reads it. What cannot be read at all is refused
// where the log is opened for what it is wanted for, which says more.
MendedLog MendedRead(const Robot& robot, const LogParts& parts,
                     const LogReaderOptions& reading,
                     const RowSearch& find_frozen) {
  try {
    Log log;
    LogReader(parts.log, reading).Read(kMostInspectedRows, &log);
    if (log.size() < 3) return {};
    const StampFigures stamps = AuditStamps(log);
    if (!(stamps.unit > 0)) return {};
    log.t *= stamps.unit;
    return MendedOf(robot, InSeconds(parts, stamps.unit), find_frozen,
                    stamps.mean_step, std::move(log));
  } catch (const ChangedFile&) {
    throw;
  } catch (const InputError&) {
    return {};
  }
}

MendedLog MendedPositions(const Robot& robot, const LogParts& parts,
                          LogReaderOptions reading) {
  reading.need_torque = false;
  reading.want_reference = true;
  return MendedRead(robot, parts, reading,
                    [&](const Log& mended, const LogJumps&, double) {
                      return FindStuckPositions(robot, mended);
                    });
}

MendedLog StuckRowsIn(const Robot& robot, const LogParts& parts,
                      const std::optional<double>& bandwidth_hz,
                      LogReaderOptions reading) {
  LogReaderOptions inspected = reading;
  inspected.want_velocity = inspected.commands_do = inspected.currents_do =
      true;
  MendedLog mended =
      MendedRead(robot, parts, inspected,
                 [&](const Log& log, const LogJumps& jumps, double mean_step) {
                   return FindAllFrozenChannels(robot, log, jumps, mean_step);
                 });
  bool stay = mended.keeps_wrong_rows;
  reading.left_out[parts.log.name] = mended.rows;
  reading.position_turns[parts.log.name] = mended.turns;
  for (const TimeRange& crop : parts.crops) {
    stay = stay || (!mended.rows.empty() &&
                    !IsEnoughLeft(parts.log, crop, bandwidth_hz, reading));
  }
  if (!stay) return mended;
  mended.rows.clear();
  auto& told = mended.findings;
  told.erase(std::remove_if(told.begin(), told.end(),
                            [](const auto& one) { return one.leads; }),
             told.end());
  return mended;
}

using Mending = std::function<MendedLog(const LogParts&)>;
std::vector<DataFinding> Mend(const std::vector<UsedLog>& used,
                              const Mending& mending,
                              LogReaderOptions* reading) {
  const std::vector<LogParts> logs = PartsOf(used);
  std::vector<MendedLog> mended(logs.size());
  tbb::parallel_for(size_t{0}, logs.size(),
                    [&](size_t k) { mended[k] = mending(logs[k]); });
  std::vector<DataFinding> findings;
  for (size_t k = 0; k < logs.size(); ++k) {
    const std::string& name = logs[k].log.name;
    if (!mended[k].rows.empty()) {
      reading->left_out[name] = std::move(mended[k].rows);
    }
    if (!mended[k].turns.empty()) {
      reading->position_turns[name] = std::move(mended[k].turns);
    }
    std::move(mended[k].findings.begin(), mended[k].findings.end(),
              std::back_inserter(findings));
  }
  return findings;
}

}  // namespace

std::vector<DataFinding> MendPositions(const Robot& robot,
                                       const std::vector<UsedLog>& used,
                                       LogReaderOptions* reading) {
  const LogReaderOptions as_recorded = *reading;
  return Mend(
      used,
      [&](const LogParts& parts) {
        return MendedPositions(robot, parts, as_recorded);
      },
      reading);
}

std::vector<DataFinding> LeaveOutStuckRows(
    const Robot& robot, const std::vector<UsedLog>& used,
    const std::optional<double>& bandwidth_hz, LogReaderOptions* reading) {
  const LogReaderOptions as_recorded = *reading;
  return Mend(
      used,
      [&](const LogParts& parts) {
        return StuckRowsIn(robot, parts, bandwidth_hz, as_recorded);
      },
      reading);
}

}  // namespace armcal

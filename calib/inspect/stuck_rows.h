#pragma once

#include <optional>
#include <vector>

#include "calib/diagnose/data/audit.h"
#include "model/log_files/log_reader_options.h"
#include "model/log_files/log_source.h"
#include "model/log_files/time_range.h"
#include "model/robot/robot.h"

namespace armcal {

// A log and the part of it that is used.
struct UsedLog {
  LogSource log;
  TimeRange crop;
};

// What of the positions of logs is known to be wrong is not read from then on,
// by whatever reads with these options. Whole turns are taken out where an
// encoder wraps (LogReaderOptions::position_turns). Rows are left out
// (LogReaderOptions::left_out) at which a position stands still until it jumps
// (FindStuckPositions), and, where a zero is lost, those of all zeros but the
// one that the joint has for most of the log (RowsOfOtherZeros): which one is
// right, nobody knows, and two of them are no motion. Both are looked for in a
// log's first kMostInspectedRows rows. What was done is told of the used parts.
// No rows of a log are left out where a used part would be left with less than
// 2 s, which is told: nothing is to be trusted then.
std::vector<DataFinding> MendPositions(const Robot& robot,
                                       const std::vector<UsedLog>& used,
                                       LogReaderOptions* reading);

// The same, and rows at which a torque or a position of a joint has one number
// while the arm goes on (FindFrozenChannels) are not read either: of all
// joints, since the links of one are moved by the others' torques, and a torque
// that is not known is no equation. What was left out leads a diagnosis. No
// rows of a log are left out where any part of it would be left with less than
// 2 s of motion in stretches that a diagnosis can use; WrongReadings says what
// is wrong with it then. `bandwidth_hz` as in a diagnosis.
std::vector<DataFinding> LeaveOutStuckRows(
    const Robot& robot, const std::vector<UsedLog>& used,
    const std::optional<double>& bandwidth_hz, LogReaderOptions* reading);

}  // namespace armcal

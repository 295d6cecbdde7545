#pragma once

#include <optional>
#include <vector>

#include "calib/diagnose/data/audit.h"
#include "model/log_files/log_reader_options.h"
#include "model/log_files/log_source.h"
#include "model/log_files/time_range.h"
#include "model/robot/robot.h"

namespace armcal {

// Rows of logs at which a torque or a position of a joint has one number while
// the arm goes on (FindFrozenChannels) are not read from then on
// (LogReaderOptions::left_out): of all joints, since the links of one are moved
// by the others' torques, and a torque that is not known is no equation. What
// was left out leads a diagnosis. They are looked for in a log's first
// kMostInspectedRows rows. A log is read as it is where any part of it would be
// left with less than 2 s of motion in stretches that a diagnosis can use;
// WrongReadings says what is wrong with it then. `bandwidth_hz` as in a
// diagnosis.
struct UsedLog {
  LogSource log;
  TimeRange crop;
};
std::vector<DataFinding> LeaveOutStuckRows(
    const Robot& robot, const std::vector<UsedLog>& used,
    const std::optional<double>& bandwidth_hz, LogReaderOptions* reading);

}  // namespace armcal

#pragma once

#include <string>
#include <vector>

#include "calib/diagnose/data/audit.h"
#include "calib/inspect/stuck_rows.h"
#include "calib/log_input.h"
#include "model/log_files/log_reader_options.h"
#include "model/log_files/log_source.h"
#include "model/robot/robot.h"

namespace armcal {

// The logs of several inputs, with the parts that are used.
std::vector<UsedLog> UsedParts(const std::vector<const LogInput*>& inputs);

// What is asked of logs, beside the unit of their time.
struct ReadingQuestions {
  bool scales = true;  // what scales torques alone
  // Signs, order and units of positions and torques, which are told beside the
  // file's inertias and lengths.
  bool arm = true;
  int most_rows = 0;  // the first of each log; 0: as inspect looks at
};

// What makes logs those of another arm than the robot's: units, signs or the
// order of columns, or gravity that points elsewhere by more than a base is
// tilted (InspectLog). Whatever fits them then is no effect, however
// well it fits. Each leads a diagnosis. What only scales torques is not among
// them where `scales` is false: a reference that was recorded alike has it,
// too. Then logs are held against the first of them: torques that are several
// times as large on all joints are in another unit. Where `scales` is true a
// joint of the file that seems to be reversed is told as well, as a doubt. Rows
// that the options leave out as stuck are not told again.
std::vector<DataFinding> WrongReadings(const Robot& robot,
                                       const std::vector<LogSource>& logs,
                                       const LogReaderOptions& options,
                                       const ReadingQuestions& questions);
std::vector<DataFinding> WrongReadings(const Robot& robot,
                                       const std::vector<LogSource>& logs,
                                       const LogReaderOptions& options,
                                       bool scales);

}  // namespace armcal

#pragma once

#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "calib/logs/prepared_logs.h"
#include "model/log_files/kept_log.h"
#include "model/text/kept_items.h"

namespace armcal {

// What copies of a LogSet share. Only `rows` and `last` change, under `pass`:
// they hold what could be read or made again.
struct LogSet::Recorded {
  // A log's rows from the first; with recorded rates, if they are wanted.
  KeptLog* Rows(int log, bool rates);

  std::shared_ptr<MemoryBudget> memory;
  TimeRange crop;
  std::vector<std::string> names;
  std::vector<TimeBase> time_bases;
  std::string torque_source;
  std::vector<std::shared_ptr<const MadeTorque>> made;

  std::mutex pass;
  std::vector<KeptLog> rows;
  std::shared_ptr<PreparedLogs::Kept> last;  // of the last preparation
};

}  // namespace armcal

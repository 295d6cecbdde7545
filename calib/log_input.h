#pragma once

#include <vector>

#include "model/log_files/log_source.h"
#include "model/log_files/time_range.h"

namespace armcal {

// Logs to work through together.
struct LogInput {
  std::vector<LogSource> logs;  // files, or arrays in memory
  TimeRange crop = {};          // of each, s since its first row
};

}  // namespace armcal

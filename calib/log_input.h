#pragma once

#include <string>
#include <vector>

#include "model/log_files/log_source.h"
#include "model/log_files/time_range.h"

namespace armcal {

// Logs to work through together.
struct LogInput {
  std::vector<LogSource> logs;  // files, or arrays in memory
  TimeRange crop = {};          // of each, s since its first row
};

std::vector<std::string> NamesOf(const std::vector<LogSource>& logs);

// OptionError where there is no log, one is named twice, or held out whole from what it is
// calibrated on.
void CheckApart(const LogInput& logs, const LogInput& validation);
// Of further logs the first that is named twice or is one of those; empty:
// none.
std::string NamedBefore(const LogInput& logs, const LogInput& validation,
                        const std::vector<LogSource>& more);

}  // namespace armcal

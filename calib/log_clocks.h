#pragma once

#include <vector>

#include "calib/diagnose/data/audit.h"
#include "model/log_files/log_reader_options.h"
#include "model/log_files/log_source.h"

namespace armcal {

// Of logs whose stamps are not when their samples were taken, as positions and
// velocities of all joints tell (EstimateSampleClock), a finding each, which
// leads a diagnosis. They are read with the time that their joints tell from
// then on (LogReaderOptions::sample_times), but for logs of more than 2^20
// rows.
std::vector<DataFinding> MendClocks(const std::vector<LogSource>& logs,
                                    LogReaderOptions* reading);

}  // namespace armcal

#pragma once

#include <string>
#include <vector>

#include "model/log_files/log_reader_options.h"
#include "model/log_files/log_source.h"
#include "model/robot/robot.h"

namespace armcal {

// Reconstructs the torques of logs that have commands in their place, by the
// law of the drives in the file `controller` (docs/simulate.md). Throws
// InputError.
void ReconstructTorques(const Robot& robot, const std::string& controller,
                        const std::vector<LogSource>& logs,
                        LogReaderOptions* reading);

}  // namespace armcal

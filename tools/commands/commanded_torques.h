#pragma once

#include <string>
#include <vector>

#include "model/log_files/log_reader.h"
#include "model/robot/robot.h"
#include "tools/command.h"

namespace armcal {

// Where --controller is given: makes the torques of those logs that have
// commands in their place. Throws InputError, UsageError.
void MakeTorquesOfCommands(const CommandInput& input, const Robot& robot,
                           const std::vector<std::string>& logs,
                           LogReaderOptions* options);

}  // namespace armcal

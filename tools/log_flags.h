#pragma once

#include <string>
#include <vector>

#include "calib/log_input.h"
#include "calib/robot_source.h"
#include "tools/command.h"

namespace armcal {

// What logs of these names are read from: memory where the input has them, else
// files.
LogSource SourceOf(const CommandInput& input, const std::string& name);
std::vector<LogSource> SourcesOf(const CommandInput& input,
                                 const std::vector<std::string>& names);

// What the flags name, as the functions of calib take it: files, or what the
// input holds in memory under a name. Throw UsageError.
LogInput LogInputFromFlags(const CommandInput& input);         // --log --crop
LogInput ValidationInputFromFlags(const CommandInput& input);  // --validate ..
RobotSource RobotSourceFromFlags(const CommandInput& input);   // --robot --base

}  // namespace armcal

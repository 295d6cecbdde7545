#pragma once

#include <vector>

#include "calib/excite_options.h"
#include "model/robot/robot.h"
#include "tools/command.h"

namespace armcal {

std::vector<FlagGroup> ExcitationFlagGroups();

// What the flags of armcal excite ask for. Throws UsageError.
ExciteOptions ExciteOptionsFromFlags(const CommandInput& input,
                                     const Robot& robot);

}  // namespace armcal

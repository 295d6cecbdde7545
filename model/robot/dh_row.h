#pragma once

#include <optional>

#include "model/robot/robot.h"

namespace armcal {

// The row with which SetDhPose sets this pose; nothing where none does (to
// 1e-12 m or rad).
std::optional<DhParameters> DhRow(const Link& link, DhConvention convention);

}  // namespace armcal

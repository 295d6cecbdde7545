#pragma once

#include <optional>

#include "model/log_files/log.h"

namespace armcal {

// By how many seconds joint j's recorded velocity is behind its position
// (negative: before it), where that is 12.5 ms or more and sure: over stretches
// of 50 ms the position changes by
//   gain * integral of qd + delay * change of qd,
// and the law of one half of the log has to leave less than half of the squares
// in the other that a gain alone leaves, both ways, with the same delay.
// Nothing where that is not so. The log has q, qd and its time in s.
std::optional<double> VelocityDelay(const Log& log, int j);

}  // namespace armcal

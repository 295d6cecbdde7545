#pragma once

#include <optional>

#include "model/log_files/log.h"

namespace armcal {

// By how many seconds joint j's recorded velocity is behind its position
// (negative: before it), where that is 12.5 to 80 ms and sure: over stretches
// of 50 ms the position changes by
//   gain * integral of qd over the stretch that much later,
// and the delay that fits one half of the log best has to leave less than half
// of the squares in the other that none leaves, both ways, and to be the same.
// It is searched, as a wobble of 10 Hz turns round within 50 ms: there a delay
// is no share of the velocity's change. Nothing where that is not so. The log
// has q, qd and its time in s.
std::optional<double> VelocityDelay(const Log& log, int j);

}  // namespace armcal

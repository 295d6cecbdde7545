#pragma once

#include <vector>

#include "calib/diagnose/judge/held_out.h"
#include "calib/logs/torque_trace.h"

namespace armcal {

// Torques that are held out, low-passed at the bandwidth of the diagnosis,
// beside what three models predict: the robot file's (or the reference's), the
// refitted one, and, with `effects`, the one that has them. A joint's residual
// counts for TorqueTrace::where as it does for the figures of the gap.
std::vector<TorqueTrace> TraceHeldOut(const GapRows& rows,
                                      const HeldOut::Residuals& residuals,
                                      bool effects);

}  // namespace armcal

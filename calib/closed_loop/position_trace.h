#pragma once

#include <string>
#include <vector>

#include "calib/closed_loop/windows.h"
#include "calib/numerics/series_envelope.h"

namespace armcal {

// How an arm followed the commands of a log, for drawing: n signals each, rad
// or m: measured minus commanded; of every simulation, simulated minus
// commanded; of every simulation, measured minus simulated.
struct PositionTrace {
  std::string log;
  SeriesEnvelope follows;
};

// Of every log of the windows, without what their simulations begin with.
std::vector<PositionTrace> TracePositions(const LoopWindows& windows,
                                          const std::vector<LoopRun>& runs,
                                          int most_bins);

}  // namespace armcal

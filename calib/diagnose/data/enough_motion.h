#pragma once

#include <string>
#include <vector>

#include "calib/diagnose/data/segment.h"
#include "calib/logs/log_set.h"

namespace armcal {

// Periods of the bandwidth of torques, above which a step between samples
// splits a log: over a quarter of one a line is as good as what was lost.
constexpr double kGapPeriods = .25;

// The gaps of logs that split them at that bandwidth.
struct SplittingGaps {
  long count = 0;
  double longest = 0;  // s

  std::string Text() const;  // "its 27 gaps of up to 0.03 s"
  // Hz, the highest whole one at which none of them does.
  double BridgingBandwidth() const;
};
SplittingGaps GapsThatSplit(double bandwidth_hz, const LogSet& logs);

// Throws InputError where the logs have no rows: nothing to fit or to judge by.
// `sets_bandwidth`: other logs, whose rate the bandwidth was told by; null:
// none.
void CheckMotion(const std::vector<GapSegment>& segments, double bandwidth_hz,
                 const LogSet& logs, const LogSet* sets_bandwidth = nullptr);

}  // namespace armcal

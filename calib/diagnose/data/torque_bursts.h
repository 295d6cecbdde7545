#pragma once

#include <vector>

#include "calib/diagnose/data/audit.h"
#include "calib/diagnose/data/segment.h"

namespace armcal {

// A second in which a joint's torque was faster and larger than otherwise.
struct TorqueBurst {
  int joint;  // from 0
  TimeRange window;
  double fast;   // rms above the bandwidth, N m or N
  double usual;  // rms in the middle one of the seconds of motion, N m or N
};

// Seconds in which a loop was next to losing its stability, or lost it: its
// torque, reconstructed from positions that swing faster than what is judged
// (`bandwidth_hz`), is as large as that of a motion, up to thousands of times,
// and whatever such a second says, a delay's or a gain's, would drown the rest
// of the log. Of recorded torques, which drives limit, there are none.
std::vector<TorqueBurst> FindTorqueBursts(const GapSegment& segment,
                                          double bandwidth_hz);

// Times not to be believed, with what filters at the bandwidth make of them on
// both sides: as much as at the ends of a log (GapRows::kPeriodsAtEnds).
std::vector<TimeRange> TimesOf(const std::vector<TorqueBurst>& bursts,
                               double bandwidth_hz);

// What a report says of them; nothing where there are none.
std::vector<DataFinding> TellTorqueBursts(
    const Robot& robot, const std::vector<GapSegment>& segments,
    double bandwidth_hz);

}  // namespace armcal

#pragma once

#include <vector>

#include "calib/gap_audit.h"
#include "calib/gap_segments.h"

namespace armcal {

// A second in which a joint's torque was far beyond what it is otherwise.
struct TorqueBurst {
  int joint;  // from 0
  TimeRange window;
  double rms, usual;  // N m or N, usual: of nine seconds in ten of its motion
};

// Seconds in which a loop lost its stability: its torque, made of positions
// that swing faster than the arm can follow, is thousands of times that of a
// motion, and whatever such a second says, a delay's or a gain's, would drown
// the rest of the log. Of recorded torques, which drives limit, there are none.
std::vector<TorqueBurst> FindTorqueBursts(const GapSegment& segment);

// Times not to be believed, with what filters make of them on both sides.
std::vector<TimeRange> TimesOf(const std::vector<TorqueBurst>& bursts);

// What a report says of them; nothing where there are none.
std::vector<DataFinding> TellTorqueBursts(
    const Robot& robot, const std::vector<GapSegment>& segments);

}  // namespace armcal

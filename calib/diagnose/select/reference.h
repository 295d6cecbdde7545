#pragma once

#include <vector>

#include "calib/diagnose/data/baseline.h"
#include "calib/diagnose/data/segment.h"

namespace armcal {

// The robot as logs of it from before show it: what changes since are judged
// against.
struct ReferenceModel {
  // Its robot is the one that fits those logs best within its freedom, since
  // many effects are in proportion to torques that must be right. What that
  // leaves there and the catalogue explains is known: part of the model, its
  // size as uncertain as all logs together leave it.
  GapBaseline baseline;
  // By how much torque is recorded later than the motion, s.
  double delay = 0;
};

// Fits `baseline` to the segments, whose torque is from now on as if it had
// been recorded without delay.
ReferenceModel FitReference(const GapBaseline& baseline, double bandwidth_hz,
                            std::vector<GapSegment>* segments);

// Undoes a delay of the recorded torque, s.
void AdvanceTorque(double delay, std::vector<GapSegment>* segments);

}  // namespace armcal

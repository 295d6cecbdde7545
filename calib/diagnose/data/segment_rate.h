#pragma once

#include "calib/diagnose/data/segment.h"

namespace armcal {

// Keeps every m-th sample of a segment, m the largest number that leaves
// kSamplesPerPeriod samples to a period of the motion's bandwidth: a log at
// 1 kHz says no more of a motion low-passed at 50 Hz than every fourth of its
// samples does, and all that follows takes a fourth of the time. The torque is
// low-passed at motion_bandwidth_hz first, so that its noise above does not
// appear below (aliasing); the rest is smooth or slow already.
void DecimateSegment(double motion_bandwidth_hz, GapSegment* segment);

}  // namespace armcal

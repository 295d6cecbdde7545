#pragma once

#include <vector>

#include "calib/inspect/reading_change.h"

namespace armcal {

// A reading that differs from another by one change.
struct Candidate {
  LogReading reading;
  ReadingChange change;
};

// Two joints exchanged, and each joint's position, torque or both turned round;
// of the columns that move (`moves`, as they are logged).
std::vector<Candidate> WiringCandidates(const LogReading& from,
                                        const std::vector<bool>& moves);

// Gravity of that size, m/s^2, along each axis of the world, and none.
std::vector<Candidate> GravityCandidates(const LogReading& from,
                                         double magnitude);

}  // namespace armcal

#pragma once

#include <vector>

#include "calib/inspect/log_reading.h"
#include "model/log_files/log.h"

namespace armcal {

// Of which columns the recorded velocity is opposite to the position's slope:
// one of them has the wrong sign.
std::vector<bool> OppositeVelocities(const Log& log);

// Where torques fit alike with the sign of a joint's position or torque turned,
// a velocity that is opposite says that it is the position. Of all joints' at
// once most velocities say so; else it is the torques.
void BelieveVelocities(const std::vector<bool>& opposite,
                       ReadingFinding* finding);

}  // namespace armcal

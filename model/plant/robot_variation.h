#pragma once

#include <cstdint>

#include "model/robot/robot.h"

namespace armcal {

// A robot that is what `robot`'s file says but for errors of relative standard
// deviation `share`, as a real one is. Each link's mass distribution is
// stretched, sheared and scaled at random, which keeps it physically possible;
// armature, viscous and Coulomb friction are scaled. Massless links stay so.
Robot VaryRobot(const Robot& robot, double share, uint64_t seed);

}  // namespace armcal

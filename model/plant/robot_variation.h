#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "model/robot/robot.h"

namespace armcal {

// Gives links of an inertia that no body has (WhyUnphysical) the nearest that
// one can have, mass and centre as they are. Returns the names of these links.
std::vector<std::string> MakeLinksPossible(Robot* robot);

// A robot that is what `robot`'s file says but for errors of relative standard
// deviation `share`, as a real one is. Each link's mass distribution is
// stretched, sheared and scaled at random, which keeps it physically possible
// once MakeLinksPossible() has made it so; armature, viscous and Coulomb
// friction are scaled. Massless links stay so.
Robot VaryRobot(const Robot& robot, double share, uint64_t seed);

}  // namespace armcal

#pragma once

#include <string>

#include "model/plant/hidden/hidden_effect.h"

namespace armcal {

// The joint that this one is coupled to: the next, else the one before; one of
// the same type where there is one.
EffectSite NeighbourJoint(const EffectSite& site);
// Empty, or why there is none.
std::string WhyNoNeighbour(const SimulatedRobot& robot, int joint);

}  // namespace armcal

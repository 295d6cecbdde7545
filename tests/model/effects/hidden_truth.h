#pragma once

#include <map>
#include <string>
#include <vector>

#include "model/dynamics/simulated_robot.h"
#include "model/robot/robot.h"

namespace armcal {

// Hides the effect in the plant of `robot`, its first parameters as given and
// the others as usual; returns what truth.json would say. joint -1: the whole
// robot. In a header of its own, because hidden effects and those of estimation
// have classes of the same names.
std::map<std::string, double> HideEffect(const std::string& effect, int joint,
                                         const Robot& robot, double duration,
                                         SimulatedRobot* plant,
                                         const std::vector<double>& first = {});

}  // namespace armcal

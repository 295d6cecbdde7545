#pragma once

#include <string>
#include <vector>

#include "model/plant/hidden/scenario.h"
#include "model/robot.h"

namespace armcal {

// "elasticity@2:stiffness=20,damping=.02;base_tilt": effects with a semicolon
// between them, the joint by number or name, parameters that are not given as
// usual. Throws UsageError.
std::vector<ChosenEffect> ParseEffects(const std::string& text,
                                       const Robot& robot);

// All kinds with their parameters, for people.
std::string EffectList();

}  // namespace armcal

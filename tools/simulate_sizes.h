#pragma once

#include <string>

#include "model/plant/hidden/scenario.h"

namespace armcal {

// Sets the parameter of effect->parameters that decides the value `name` of an
// effect to where the effect has `size` of it, in `unit` (blanks aside, "Nm");
// `plant` is the robot that the effect is to be applied to. Throws UsageError
// where there is no such value, in that unit, or none of that size.
void SetEffectSize(const std::string& name, double size,
                   const std::string& unit, const SimulatedRobot& plant,
                   const EffectContext& context, ChosenEffect* effect);

}  // namespace armcal

#pragma once

#include <string>
#include <vector>

#include "model/plant/hidden/scenario.h"

namespace armcal {

// "mass=2kg": how large a value of an effect is to be.
struct EffectSize {
  std::string name;
  double size;
  std::string unit;  // blanks aside, "Nm"
};

// Sets parameters of the effect so that its values have these sizes on `plant`,
// the robot that it is to be applied to. Parameters that are `given`, one entry
// each, stay. Throws UsageError where there is no such value, in that unit, or
// no parameters give all the sizes at once.
void SetEffectSizes(const std::vector<EffectSize>& sizes,
                    std::vector<bool> given, const SimulatedRobot& plant,
                    const EffectContext& context, ChosenEffect* effect);

}  // namespace armcal

#pragma once

#include <string>
#include <vector>

#include "model/plant/hidden/scenario.h"

namespace armcal {

// "elasticity@2:windup=.003;payload:mass=2kg": effects with a semicolon between
// them, the joint by number or name, parameters that are not given as usual. A
// number with a unit is the size of one of the effect's values on the robot of
// the scenario. Throws UsageError.
std::vector<ChosenEffect> ParseEffects(const std::string& text,
                                       const Scenario& scenario);

// All kinds with their parameters, for people and for programs.
std::string EffectList();
std::string EffectListJson();

}  // namespace armcal

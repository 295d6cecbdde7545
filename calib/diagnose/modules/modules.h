#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "calib/diagnose/candidates/corrected_robot.h"

namespace armcal {

// A corrected robot's laws as source files for a simulator's loop, and what
// they do not hold, a sentence each.
struct EffectModule {
  std::string name;                                        // "python" or "c"
  std::vector<std::pair<std::string, std::string>> files;  // names and texts
  std::vector<std::string> losses;
};

const std::vector<std::string>& EffectModuleNames();
// `names`: of EffectModuleNames(). effects.json is to lie beside them.
std::vector<EffectModule> MakeEffectModules(
    const CorrectedRobot& robot, const std::vector<std::string>& names);
// modules[] {module, files[], losses[]}.
nlohmann::json EffectModulesJson(const std::vector<EffectModule>& modules);

}  // namespace armcal

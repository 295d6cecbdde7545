#pragma once

#include <nlohmann/json.hpp>

#include "model/plant/hidden/scenario.h"

namespace armcal {

// truth.json: what a log of this scenario hides.
nlohmann::json TruthJson(const Scenario& scenario, const ScenarioRun& run);

}  // namespace armcal

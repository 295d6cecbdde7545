#pragma once

#include <nlohmann/json.hpp>

namespace armcal {

// A number, or null where it is infinite or undefined: JSON has neither.
nlohmann::json JsonNumber(double x);

}  // namespace armcal

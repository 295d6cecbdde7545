#include "calib/numerics/json_figures.h"

#include <cmath>

namespace armcal {

nlohmann::json JsonNumber(double x) {
  return std::isfinite(x) ? nlohmann::json(x) : nlohmann::json(nullptr);
}

}  // namespace armcal

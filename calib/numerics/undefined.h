#pragma once

#include <limits>

namespace armcal {

// A figure that is not defined: null in JSON.
inline constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

}  // namespace armcal

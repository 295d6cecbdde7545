#pragma once

#include <functional>
#include <string>

namespace armcal {

// Told what is being done and how far it is, 0 to 1; below 0: nobody knows.
using Progress = std::function<void(const std::string& stage, double fraction)>;

}  // namespace armcal

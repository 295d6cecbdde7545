#pragma once

#include <string>

namespace armcal {

// The shortest text that reads back as x, bit for bit; no "-0".
std::string ExactText(double x);

}  // namespace armcal

#pragma once

#include <string>
#include <vector>

namespace armcal {

// As a sentence has them: "a", "a and b", "a, b and c"; empty of none.
std::string Enumeration(const std::vector<std::string>& names);

}  // namespace armcal

#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace armcal {

// The words of a column's name: its runs of letters and of digits, in lower
// case ("/ft/Wrench.force_x" has ft, wrench, force and x).
std::vector<std::string> ColumnWords(std::string_view name);

}  // namespace armcal

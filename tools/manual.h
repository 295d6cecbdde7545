#pragma once

#include <string>

namespace armcal {

// armcal.1 in roff, of the table of commands and their flags.
std::string ManualPage();

}  // namespace armcal

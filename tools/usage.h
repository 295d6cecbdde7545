#pragma once

#include <string>
#include <vector>

#include "tools/command.h"

namespace armcal {

// `text` broken into lines of at most `width` and indented by `column`, but for
// the first, which is to begin there.
std::string Wrapped(const std::string& text, size_t column, size_t width = 80);

// Each a screen, as wide as the terminal within 80 to 120 columns.
std::string GeneralHelp(const std::vector<Command>& commands);
// The flags that are usual, and the names of the others; or all of them.
std::string CommandHelp(const Command& command, bool all);

}  // namespace armcal

#pragma once

#include <string>

#include "tools/command.h"
#include "tools/report/report_page.h"

namespace armcal {

// What a command read under this name: a file, or a log of `input` that is in
// memory. Its hash is then of its arrays in their order: of a line "NAME ROWS
// COLUMNS" and the bytes of each.
SourceFile HashInput(const CommandInput& input, const std::string& name);

}  // namespace armcal

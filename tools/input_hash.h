#pragma once

#include <string>

#include "tools/command.h"
#include "tools/report/report_page.h"

namespace armcal {

// What a command read under this name: a file, a folder, or a log of `input`
// that is in memory. The hash of a folder is that of its files' hashes, by
// name; that of a log in memory of its arrays in their order: of a line "NAME
// ROWS COLUMNS" and the bytes of each.
SourceFile HashInput(const CommandInput& input, const std::string& name);

}  // namespace armcal

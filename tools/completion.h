#pragma once

#include <string>
#include <vector>

#include "tools/command.h"

namespace armcal {

// What armcal completion prints: for "bash", "zsh" or "fish" the script that
// the shell reads, which asks armcal again with "--line" and the command line
// up to the cursor, and gets what its last word may become, one a line, with
// its meaning after a tab: commands, flags, a flag's words, files and folders.
// What ends in "=", "," or "/" is to be gone on with. Throws UsageError.
std::string Completion(const std::vector<Command>& commands,
                       const std::vector<std::string>& words);

}  // namespace armcal

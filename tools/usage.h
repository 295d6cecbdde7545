#pragma once

#include <string>
#include <vector>

#include "tools/command.h"

namespace armcal {

// `text` broken into lines of at most `width` and indented by `column`, but for
// the first, which is to begin there.
std::string Wrapped(const std::string& text, size_t column, size_t width = 80);

std::string GeneralHelp();
std::string CommandHelp(const Command& command);

// The entry of `names` that `name` was probably meant to be: at most three
// letters differ. Empty where none is near.
std::string NearestName(const std::string& name,
                        const std::vector<std::string>& names);

// Sets the gflags of `command` from its command line (argv[0] is the command's
// name). Throws UsageError: an unknown flag (with the nearest known one), a
// flag without a value, a value of the wrong type, a word that is no flag.
// Unlike gflags' own parser it never exits and knows only the command's flags.
void ParseFlags(const Command& command, int argc, char** argv);

}  // namespace armcal

#pragma once

#include <map>
#include <string>
#include <vector>

#include "tools/command.h"

namespace armcal {

// Sets the gflags of `command` from its command line (argv[0] is the command's
// name) and from its --flagfile, whose flags count where the command line does
// not have them. Throws UsageError: an unknown flag (with the nearest known
// one), a flag without a value, a value of the wrong type, a word that is no
// flag. Unlike gflags' own parser it never exits and knows only the command's
// flags.
//
// Returns where in the file its flags stand ("run.flags: line 3: "), for what
// is found wrong with their values later.
std::map<std::string, std::string> ParseFlags(const Command& command, int argc,
                                              char** argv);

// The flags of the command parsed last that are not at their defaults, as they
// would be typed, in the order of --help.
std::vector<std::string> FlagsAsTyped();

}  // namespace armcal

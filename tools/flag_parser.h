#pragma once

#include <map>
#include <string>

#include "tools/command.h"

namespace armcal {

// What a command line says.
struct ParsedFlags {
  FlagValues values;
  // Where in a --flagfile those flags stand that count as it has them
  // ("run.flags: line 3: "), for what is found wrong with their values later.
  std::map<std::string, std::string> places;
};

// The flags of `command` by its command line (argv[0] is the command's name)
// and by its --flagfile, whose flags count where the command line does not
// have them. Throws UsageError: an unknown flag (with the nearest known
// one), a flag without a value, a value of the wrong type, a word that is no
// flag where the command takes none. Unlike gflags' own parser it never exits
// and knows only the command's flags.
ParsedFlags ParseFlags(const Command& command, int argc, char** argv);

}  // namespace armcal

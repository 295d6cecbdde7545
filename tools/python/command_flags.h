#pragma once

#include <map>
#include <string>

#include "tools/command.h"

namespace armcal {

using FlagTexts = std::map<std::string, std::string>;

// The command of this name. Throws UsageError.
const Command& CommandNamed(const std::string& name);

// The values of a command's flags as its command line would set them. Throws
// UsageError for flags that the command does not take.
FlagValues FlagsOf(const Command& command, const FlagTexts& texts);

}  // namespace armcal

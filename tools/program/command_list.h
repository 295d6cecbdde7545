#pragma once

#include <string>
#include <vector>

#include "tools/command.h"

namespace armcal {

// All commands in the order of help, with what they share: where results go,
// and how they are said. To add one, write its file in tools/commands and its
// line here. Help, the manual page and the shells' completion follow.
const std::vector<Command>& Commands();
// nullptr where there is none of that name.
const Command* FindCommand(const std::string& name);

}  // namespace armcal

#pragma once

#include <string>

namespace armcal {

// An option as messages name it: "`bandwidth`", as the members of options are
// called. Where users write something else, as --bandwidth in a shell, their
// program says so at its start and all messages follow.
std::string OptionName(const std::string& name);

// What stands before an option's name from now on, instead of the quotes. For
// the beginning of main(), before there are other threads.
void SetOptionPrefix(const std::string& prefix);

}  // namespace armcal

#pragma once

#include <string>
#include <vector>

namespace armcal {

// A flag as it was given, not yet looked at.
struct GivenFlag {
  std::string name, value;
  bool has_value = false;
  std::string place;  // "run.flags: line 3: "; empty for the command line
};

// The flag of "--name=value" or "--name"; dashes in the name are underscores.
GivenFlag SplitFlag(std::string argument);

// The flags of a file, one "--flag=value" a line; blank lines and those that
// begin with # are passed over, nothing is unquoted. Throws InputError where
// there is no such file, UsageError with file and line for what is no flag or
// another --flagfile.
std::vector<GivenFlag> ReadFlagFile(const std::string& path);

}  // namespace armcal

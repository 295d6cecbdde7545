#pragma once

#include <stdexcept>
#include <string>
#include <vector>

namespace armcal {

enum ExitCode {
  kExitOk = 0,
  kExitNegative = 1,  // ran, but the verdict is negative
  kExitUsage = 2,
  kExitBadInput = 3,
  kExitInternal = 4,
};

// A wrong command line: printed with a pointer to --help, exit code 2.
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// Flags that stand together in help, under a heading.
struct FlagGroup {
  std::string heading;
  std::vector<std::string> flags;
  bool usual = true;  // others are only named by --help; --helpfull has them
};

// A command of the armcal binary: flags -> library call -> print. To add one,
// write its file and its line in command.cc. Help, the manual page and the
// shells' completion follow from this table and from the flags' definitions,
// whose descriptions hold the value's form in backquotes: "robot `FILE`: ...".
struct Command {
  const char* name;
  const char* summary;             // one line
  std::vector<FlagGroup> groups;   // in the order of help; no others are taken
  std::vector<const char*> usage;  // command lines as they are typed
  int (*run)();

  std::vector<std::string> FlagNames() const;
};

// With what all of them share: where results go, and how they are said.
const std::vector<Command>& Commands();
// nullptr where there is none of that name.
const Command* FindCommand(const std::string& name);

}  // namespace armcal

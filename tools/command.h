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

// A command of the armcal binary: flags -> library call -> print. To add one,
// write its file and its line in command.cc.
struct Command {
  const char* name;
  const char* summary;  // one line
  // What --help shows, in this order; flags not listed are refused.
  std::vector<std::string> flags;
  int (*run)();
};

const std::vector<Command>& Commands();

}  // namespace armcal

#pragma once

#include <stdexcept>

namespace armcal {

// A wrong command line: printed with a pointer to --help, exit code 2.
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace armcal

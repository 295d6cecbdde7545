#pragma once

#include "model/text/option_error.h"

namespace armcal {

// A wrong command line: printed with a pointer to --help, exit code 2.
class UsageError : public OptionError {
 public:
  using OptionError::OptionError;
};

}  // namespace armcal

#pragma once

#include <stdexcept>

namespace armcal {

// Options that do not go together, or the value of one: what a caller has to
// change. What files hold is an InputError.
class OptionError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace armcal

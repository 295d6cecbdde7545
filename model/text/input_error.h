#pragma once

#include <stdexcept>
#include <string>

namespace armcal {

// Bad input: what a user gave cannot be used as it is. The message is one line
// that names the file, the place in it, the value found and what was expected;
// tools print it and exit with code 3. Numerical failures are results, not
// exceptions, and bugs are CHECKs.
class InputError : public std::runtime_error {
 public:
  // `place` is a row and column ("row 17, column tau2"), an element
  // ("line 12, <mass value>") or empty; `found` is quoted in the message and
  // may be empty where there is nothing to show.
  InputError(const std::string& file, const std::string& place,
             const std::string& found, const std::string& expected)
      : std::runtime_error(Message(file, place, found, expected)) {}

 private:
  static std::string Message(const std::string& file, const std::string& place,
                             const std::string& found,
                             const std::string& expected) {
    std::string text = file;
    if (!place.empty()) text += (text.empty() ? "" : ": ") + place;
    if (!found.empty()) text += ": found '" + found + "'";
    return text + ": " + expected;
  }
};

}  // namespace armcal

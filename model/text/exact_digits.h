#pragma once

#include <array>
#include <charconv>
#include <string>

namespace armcal {

// Appends as many digits as bring the same number back.
template <typename Number>
void AppendExactDigits(Number value, std::string* text) {
  std::array<char, 40> digits;
  const auto end =
      std::to_chars(digits.data(), digits.data() + digits.size(), value);
  text->append(digits.data(), end.ptr);
}

}  // namespace armcal

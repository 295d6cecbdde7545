#pragma once

#include <charconv>

namespace armcal {

// Of ASCII, in any locale.
inline bool IsDigit(char c) { return c >= '0' && c <= '9'; }

// std::from_chars of a double, to the last bit, but faster for what logs are
// full of: numbers of up to 15 digits.
std::from_chars_result ParseDecimalNumber(const char* first, const char* last,
                                          double* value);

}  // namespace armcal

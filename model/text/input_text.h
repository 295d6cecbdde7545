#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace armcal {

// The bytes of a small file. Throws InputError where it cannot be read or is
// larger than `max_bytes`. Reads no further, and says nothing, where it does
// not begin with `begin`: a device has no end.
std::string ReadSmallFile(const std::string& path, long max_bytes,
                          std::string_view begin = "");

// The whole text of a small file. Throws InputError where it cannot be read, is
// empty, larger than `max_bytes`, UTF-16 or contains NUL bytes.
std::string ReadTextFile(const std::string& path, long max_bytes);

// `text` without the characters in `of` at both ends.
std::string_view Trim(std::string_view text, std::string_view of = " ");

// The number that `text` is, blanks around it aside; nothing where any of it is
// left over ("2kg", "2,5"). The number may be nan or inf.
std::optional<double> ParseNumber(std::string_view text);

// Reads `count` finite numbers (1 to 6) separated by blanks. Returns an empty
// text where values[0..count-1] were set, otherwise what was expected, such as
// "expected a number in kg".
std::string WhyNotNumbers(std::string_view text, int count,
                          const std::string& unit, double* values);

// The words of `text`, split at blanks.
std::vector<std::string_view> SplitWords(std::string_view text);

// `text` fit for a one-line message: no control characters, at most 80 bytes.
std::string OneLine(std::string_view text);
// The same in quotes.
std::string Quoted(std::string_view text);

// "a, b, c", shortened to "a, b, ... and 7 more" where the list is long.
std::string JoinNames(const std::vector<std::string>& names);

// A number as people write it: 6 significant digits.
std::string NumberText(double value);

}  // namespace armcal

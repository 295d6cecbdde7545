#include "model/log_files/columns/column_words.h"

#include <cctype>

namespace armcal {

std::vector<std::string> ColumnWords(std::string_view name) {
  const auto is_letter = [](unsigned char c) { return std::isalpha(c) != 0; };
  const auto is_digit = [](unsigned char c) { return std::isdigit(c) != 0; };
  std::vector<std::string> words;
  char before = ' ';
  for (const char c : name) {
    const bool goes_on = (is_letter(c) && is_letter(before)) ||
                         (is_digit(c) && is_digit(before));
    if (is_letter(c) || is_digit(c)) {
      if (!goes_on) words.emplace_back();
      words.back() += static_cast<char>(std::tolower(c));
    }
    before = c;
  }
  return words;
}

}  // namespace armcal

#include "model/text/exact_text.h"

#include <charconv>

namespace armcal {

std::string ExactText(double x) {
  char text[40];
  const auto end = std::to_chars(text, text + sizeof(text), x == 0 ? 0.0 : x);
  return std::string(text, end.ptr);
}

}  // namespace armcal

#include "model/text/format.h"

#include <cstdarg>
#include <cstdio>

#include "model/text/decimal_point.h"

namespace armcal {

std::string Format(const char* format, ...) {
  const DecimalPoint point;
  va_list arguments, again;
  va_start(arguments, format);
  va_copy(again, arguments);
  std::string text(std::vsnprintf(nullptr, 0, format, arguments), '\0');
  std::vsnprintf(text.data(), text.size() + 1, format, again);
  va_end(again);
  va_end(arguments);
  return text;
}

}  // namespace armcal

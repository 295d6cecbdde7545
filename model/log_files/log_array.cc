#include "model/log_files/log_array.h"

#include <cstdint>
#include <cstring>

#include "model/text/exact_digits.h"

namespace armcal {
namespace {

template <typename T>
void Append(const char* bytes, std::string* line) {
  T value;
  std::memcpy(&value, bytes, sizeof(T));
  AppendExactDigits(value, line);
}

}  // namespace

void LogArray::AppendNumber(long row, long column, std::string* line) const {
  const long index = by_column ? column * rows + row : row * columns + column;
  const char* at = bytes.data() + begin + index * item;
  if (kind == 'f') {
    item == 8 ? Append<double>(at, line) : Append<float>(at, line);
  } else if (kind == 'i') {
    item == 8   ? Append<std::int64_t>(at, line)
    : item == 4 ? Append<std::int32_t>(at, line)
    : item == 2 ? Append<std::int16_t>(at, line)
                : Append<std::int8_t>(at, line);
  } else {
    item == 8   ? Append<std::uint64_t>(at, line)
    : item == 4 ? Append<std::uint32_t>(at, line)
    : item == 2 ? Append<std::uint16_t>(at, line)
                : Append<std::uint8_t>(at, line);
  }
}

}  // namespace armcal

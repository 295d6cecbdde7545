#include "model/text/decimal_number.h"

#include <cstdint>
#include <cstring>

namespace armcal {
namespace {

// Powers of ten that a double holds exactly.
constexpr int kMostExponent = 22;
constexpr double kPowers[kMostExponent + 1] = {
    1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,  1e8,  1e9,  1e10, 1e11,
    1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};

// Eight digits at once (Lemire, "Number parsing at a gigabyte per second"); of
// a machine that has the lowest byte first.
inline bool EightDigits(const char* p, std::uint64_t* number) {
  std::uint64_t x;
  std::memcpy(&x, p, sizeof(x));
  const std::uint64_t zeros = 0x3030303030303030, high = 0xf0f0f0f0f0f0f0f0;
  if (((x & high) | (((x + 0x0606060606060606) & high) >> 4)) !=
      (zeros | (zeros >> 4))) {
    return false;
  }
  x -= zeros;
  x = x * 10 + (x >> 8);
  x = (((x & 0x000000ff000000ff) * 0x000f424000000064) +
       (((x >> 16) & 0x000000ff000000ff) * 0x0000271000000001)) >>
      32;
  *number = *number * 100000000 + x;
  return true;
}

[[gnu::always_inline]] inline const char* Digits(const char* p,
                                                 const char* last,
                                                 std::uint64_t* number) {
  if (__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__) {
    while (last - p >= 8 && EightDigits(p, number)) p += 8;
  }
  for (; p != last && IsDigit(*p); ++p) *number = *number * 10 + (*p - '0');
  return p;
}

// The exponent after the digits, "e-3", added to *exponent; null where it is
// not plain.
const char* Exponent(const char* p, const char* last, int* exponent) {
  ++p;
  const bool negative = p != last && *p == '-';
  if (negative || (p != last && *p == '+')) ++p;
  const char* const first = p;
  int size = 0;
  for (; p != last && IsDigit(*p) && p - first < 4; ++p) {
    size = 10 * size + (*p - '0');
  }
  if (p == first || p - first == 4) return nullptr;
  *exponent += negative ? -size : size;
  return p;
}

}  // namespace

std::from_chars_result ParseDecimalNumber(const char* first, const char* last,
                                          double* value) {
  const char* p = first;
  const bool negative = p != last && *p == '-';
  p += negative;
  std::uint64_t number = 0;
  const char* const whole = p;
  p = Digits(p, last, &number);
  long count = p - whole;
  int exponent = 0;
  if (p != last && *p == '.') {
    const char* const fraction = ++p;
    p = Digits(p, last, &number);
    count += p - fraction;
    exponent = static_cast<int>(fraction - p);
  }
  // Whole numbers up to 10^15 and powers of ten up to 10^22 are exact, and one
  // operation on two of them rounds once.
  if (count == 0 || count > 15) return std::from_chars(first, last, *value);
  if (p != last && (*p == 'e' || *p == 'E')) {
    p = Exponent(p, last, &exponent);
    if (p == nullptr) return std::from_chars(first, last, *value);
  }
  if (exponent < -kMostExponent || exponent > kMostExponent) {
    return std::from_chars(first, last, *value);
  }
  const double x = static_cast<double>(number);
  const double size =
      exponent < 0 ? x / kPowers[-exponent] : x * kPowers[exponent];
  *value = negative ? -size : size;
  return {p, std::errc()};
}

}  // namespace armcal

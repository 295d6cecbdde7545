#include "model/text/decimal_time.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>

#include "model/text/decimal_number.h"

namespace armcal {
namespace {

// Holds any int64_t times 10^18.
__extension__ typedef __int128 Wide;

template <typename Number, int n>
constexpr std::array<Number, n> PowersOfTen() {
  std::array<Number, n> powers{};
  powers[0] = 1;
  for (int i = 1; i < n; ++i) powers[i] = 10 * powers[i - 1];
  return powers;
}

constexpr auto kIntegerPowers = PowersOfTen<int64_t, 19>();
constexpr auto kExactPowers = PowersOfTen<double, 23>();
constexpr int kMaxShift = static_cast<int>(kIntegerPowers.size()) - 1;
constexpr int kMaxExactPower = static_cast<int>(kExactPowers.size()) - 1;

// Appends a digit; false where the sum no longer fits.
bool Append(char digit, int64_t* digits) {
  constexpr int64_t kLast = (std::numeric_limits<int64_t>::max() - 9) / 10;
  if (*digits > kLast) return false;
  *digits = 10 * *digits + (digit - '0');
  return true;
}

// The exponent after the digits, "e-3" or nothing.
bool ParseExponent(const char* p, const char* end, int* exponent) {
  *exponent = 0;
  if (p == end) return true;
  if (*p != 'e' && *p != 'E') return false;
  ++p;
  if (p != end && *p == '+') ++p;
  if (p == end || (*p == '-' && p[-1] == '+')) return false;
  const auto [stop, error] = std::from_chars(p, end, *exponent);
  constexpr int kAbsurd = 1000000;
  return error == std::errc() && stop == end && std::abs(*exponent) < kAbsurd;
}

// Makes decimals >= 0, so that differences need to shift one way only.
bool Normalise(DecimalTime* time) {
  if (time->digits == 0) time->decimals = 0;
  if (time->decimals >= 0) return true;
  const int shift = -time->decimals;
  if (shift > kMaxShift || time->digits > std::numeric_limits<int64_t>::max() /
                                              kIntegerPowers[shift]) {
    return false;
  }
  time->digits *= kIntegerPowers[shift];
  time->decimals = 0;
  return true;
}

double Seconds(const DecimalTime& time) {
  return static_cast<double>(time.digits) * std::pow(10.0, -time.decimals);
}

}  // namespace

bool ParseDecimalTime(std::string_view text, int unit_decimals,
                      DecimalTime* time) {
  const char* p = text.data();
  const char* end = p + text.size();
  const bool negative = p != end && *p == '-';
  p += negative;
  const char* const first = p;
  int64_t digits = 0;
  for (; p != end && IsDigit(*p); ++p) {
    if (!Append(*p, &digits)) return false;
  }
  int count = static_cast<int>(p - first);
  int fraction = 0;
  if (p != end && *p == '.') {
    for (++p; p != end && IsDigit(*p); ++p, ++count) {
      fraction += Append(*p, &digits);
    }
  }
  int exponent = 0;
  if (count == 0 || !ParseExponent(p, end, &exponent)) return false;
  *time = {digits, fraction - exponent + unit_decimals};
  if (!Normalise(time)) return false;
  if (negative) time->digits = -time->digits;
  return true;
}

double Difference(const DecimalTime& later, const DecimalTime& earlier) {
  const int decimals = std::max(later.decimals, earlier.decimals);
  const int shift_later = decimals - later.decimals;
  const int shift_earlier = decimals - earlier.decimals;
  // So far apart that the finer one is less than a unit of the coarser.
  if (std::max(shift_later, shift_earlier) > kMaxShift) {
    return Seconds(later) - Seconds(earlier);
  }
  const Wide digits = Wide(later.digits) * kIntegerPowers[shift_later] -
                      Wide(earlier.digits) * kIntegerPowers[shift_earlier];
  const double ratio = static_cast<double>(digits);
  return decimals <= kMaxExactPower ? ratio / kExactPowers[decimals]
                                    : ratio * std::pow(10.0, -decimals);
}

}  // namespace armcal

#pragma once

#include <cstdint>
#include <string_view>

namespace armcal {

// A time stamp exactly as it was written: digits / 10^decimals seconds. A
// double cannot do this: it resolves an epoch time of today to 0.24 us only.
struct DecimalTime {
  int64_t digits = 0;
  int decimals = 0;
};

// Parses "12.5", "-0.5", "1700000000123456789" or "1.7e+09", counted in units
// of 10^-unit_decimals s (0: s, 3: ms, 6: us, 9: ns). False for anything else
// and from 9.2e18 units on. Of more than 18 significant digits the smallest
// behind the point are dropped.
bool ParseDecimalTime(std::string_view text, int unit_decimals,
                      DecimalTime* time);

// later - earlier in s; the sign is exact, the value to one unit in the last
// place.
double Difference(const DecimalTime& later, const DecimalTime& earlier);

}  // namespace armcal

#pragma once

#include <locale.h>

namespace armcal {

// While one lives, numbers that the calling thread prints and reads have points
// whatever locale the program has chosen: a German one would put commas into
// CSV files.
class DecimalPoint {
 public:
  DecimalPoint();
  ~DecimalPoint();
  DecimalPoint(const DecimalPoint&) = delete;
  DecimalPoint& operator=(const DecimalPoint&) = delete;

 private:
  locale_t before_;
};

}  // namespace armcal

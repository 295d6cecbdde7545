#pragma once

#include <limits>

namespace armcal {

// A stretch of a log's time, s since its first row.
struct TimeRange {
  double begin = -std::numeric_limits<double>::infinity();
  double end = std::numeric_limits<double>::infinity();

  bool Contains(double t) const { return t >= begin && t <= end; }
};

}  // namespace armcal

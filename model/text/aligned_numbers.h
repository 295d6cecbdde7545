#pragma once

#include <vector>

namespace armcal {

// Numbers from the border of a cache line on, where lanes are loaded whole.
class AlignedNumbers {
 public:
  explicit AlignedNumbers(long size = 0) : lines_((size + 7) / 8) {}

  double* data() { return reinterpret_cast<double*>(lines_.data()); }
  const double* data() const {
    return reinterpret_cast<const double*>(lines_.data());
  }

 private:
  struct alignas(64) Line {
    double numbers[8] = {};
  };
  std::vector<Line> lines_;
};

}  // namespace armcal

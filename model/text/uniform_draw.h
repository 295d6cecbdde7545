#pragma once

#include <random>

namespace armcal {

// Uniform in [0, 1), the same with every standard library.
inline double UniformDraw(std::mt19937_64* random) {
  return static_cast<double>((*random)() >> 11) * 0x1p-53;
}

}  // namespace armcal

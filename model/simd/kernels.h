#pragma once

#include <string>
#include <vector>

namespace armcal::simd {

// What is computed for many samples at once, `lanes` of them side by side. The
// same source is compiled for every instruction set; results of different sets
// differ by rounding, those of one set are always the same.
struct Kernels {
  const char* instruction_set;  // "baseline", "avx2", "avx512"
  int lanes;

  // sin and cos of `count` angles, rad.
  void (*sine_cosine)(const double* angle, long count, double* sine,
                      double* cosine);
};

// Of the instruction sets that this processor has, the least first.
const std::vector<const Kernels*>& AvailableKernels();
// Of the best of them, or of the one that the environment variable
// ARMCAL_INSTRUCTION_SET names. Throws InputError if it is none of them.
const Kernels& BestKernels();

}  // namespace armcal::simd

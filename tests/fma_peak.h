#pragma once

#include <string>

namespace armcal {

// What one core can do at most: multiply-adds whose operands stay in registers.
struct MultiplyAdds {
  double (*run)();  // returns what no one needs
  double flops;     // of a run; it takes some 50 us
};

// For an instruction set of simd::AvailableKernels().
MultiplyAdds MultiplyAddsOf(const std::string& instruction_set);

}  // namespace armcal

#pragma once

// Included by the kernels of one instruction set only (kernel_table.inc), which
// names it: everything here lies in a namespace of that set's own, or the
// linker could give a machine without AVX-512 what was compiled for one with
// it. For the same reason kernels know neither Eigen nor the standard library.
#ifndef ARMCAL_INSTRUCTION_SET
#error "lanes.h belongs to kernel_table.inc"
#endif

namespace armcal::simd::ARMCAL_INSTRUCTION_SET {

// Several samples side by side, one in each lane.
constexpr int kLanes = ARMCAL_LANES;
typedef double Lanes __attribute__((vector_size(kLanes * sizeof(double))));
typedef long Integers __attribute__((vector_size(kLanes * sizeof(long))));

#define ARMCAL_INLINE inline __attribute__((always_inline))
#define ARMCAL_LAMBDA __attribute__((always_inline))

ARMCAL_INLINE Lanes Load(const double* from) {
  Lanes x;
  __builtin_memcpy(&x, from, sizeof x);
  return x;
}
ARMCAL_INLINE void Store(const Lanes& x, double* to) {
  __builtin_memcpy(to, &x, sizeof x);
}
ARMCAL_INLINE Lanes Broadcast(double x) { return x - Lanes{}; }

}  // namespace armcal::simd::ARMCAL_INSTRUCTION_SET

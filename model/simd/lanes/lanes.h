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

// Of one sample or of all lanes.
template <class T>
ARMCAL_INLINE T LoadAs(const double* from) {
  T x;
  __builtin_memcpy(&x, from, sizeof x);
  return x;
}
template <class T>
ARMCAL_INLINE void StoreAs(const T& x, double* to) {
  __builtin_memcpy(to, &x, sizeof x);
}

// Scratch on the stack.
#define ARMCAL_SCRATCH(type, count) \
  static_cast<type*>(               \
      __builtin_alloca_with_align((count) * sizeof(type) + sizeof(type), 512))

ARMCAL_INLINE Lanes Load(const double* from) {
  Lanes x;
  __builtin_memcpy(&x, from, sizeof x);
  return x;
}
ARMCAL_INLINE void Store(const Lanes& x, double* to) {
  __builtin_memcpy(to, &x, sizeof x);
}
// Whether a comparison holds in all lanes.
ARMCAL_INLINE bool All(const Integers& holds) {
#if defined(__AVX512DQ__)
  return __builtin_ia32_cvtq2mask512(
             (long long __attribute__((vector_size(64))))holds) == 0xff;
#elif defined(__AVX2__)
  return __builtin_ia32_movmskpd256((Lanes)holds) == 0xf;
#else
  bool all = true;
  for (int k = 0; k < kLanes; ++k) all = all && holds[k] != 0;
  return all;
#endif
}
// Kept in a register, where the compiler would load it anew for every product.
ARMCAL_INLINE Lanes LoadOnce(const double* from) {
  Lanes x = Load(from);
#ifdef __x86_64__
  __asm__("" : "+v"(x));
#endif
  return x;
}
ARMCAL_INLINE Lanes Broadcast(double x) { return x - Lanes{}; }

}  // namespace armcal::simd::ARMCAL_INSTRUCTION_SET

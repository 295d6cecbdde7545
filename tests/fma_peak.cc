#include "tests/fma_peak.h"

namespace armcal {
namespace {

constexpr int kChains = 10;  // independent sums; 4 cycles of latency, 2 units
constexpr long kRounds = 20000;

// Without inlining, or it would be compiled for the caller's instruction set.
#define ARMCAL_MULTIPLY_ADDS(NAME, LANES, ...)                           \
  __attribute__((noinline __VA_OPT__(, ) __VA_ARGS__)) double NAME() {   \
    typedef double Lanes                                                 \
        __attribute__((vector_size((LANES) * sizeof(double))));          \
    Lanes sum[kChains];                                                  \
    for (int i = 0; i < kChains; ++i) sum[i] = Lanes{} + i;              \
    const Lanes factor = Lanes{} + .999, term = Lanes{} + 5e-4;          \
    for (long round = 0; round < kRounds; ++round) {                     \
      for (int i = 0; i < kChains; ++i) sum[i] = sum[i] * factor + term; \
    }                                                                    \
    Lanes total = sum[0];                                                \
    for (int i = 1; i < kChains; ++i) total += sum[i];                   \
    return total[0];                                                     \
  }

ARMCAL_MULTIPLY_ADDS(Baseline, 2)
#ifdef __x86_64__
ARMCAL_MULTIPLY_ADDS(Avx2, 4, target("avx2,fma"))
#ifdef __clang__  // knows the width as an option only
ARMCAL_MULTIPLY_ADDS(Avx512, 8, target("avx512f"))
#else
ARMCAL_MULTIPLY_ADDS(Avx512, 8, target("avx512f,prefer-vector-width=512"))
#endif
#endif

constexpr double Flops(int lanes) { return 2. * kRounds * kChains * lanes; }

}  // namespace

MultiplyAdds MultiplyAddsOf(const std::string& instruction_set) {
#ifdef __x86_64__
  if (instruction_set == "avx512") return {Avx512, Flops(8)};
  if (instruction_set == "avx2") return {Avx2, Flops(4)};
#endif
  (void)instruction_set;
  return {Baseline, Flops(2)};
}

}  // namespace armcal

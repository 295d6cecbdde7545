#include <benchmark/benchmark.h>

#include <string>

#include "model/simd/kernels.h"

// What one core can do at most: multiply-adds whose operands stay in registers.
// The limits of the other benchmarks are flops divided by this rate, so it is
// measured in the same run.

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
ARMCAL_MULTIPLY_ADDS(Avx512, 8, target("avx512f,prefer-vector-width=512"))
#endif

// Items are flops.
void FmaPeak(benchmark::State& state, double (*multiply_adds)(), int lanes) {
  for (auto _ : state) benchmark::DoNotOptimize(multiply_adds());
  state.SetItemsProcessed(state.iterations() * kRounds * kChains * lanes * 2);
}

const bool registered = [] {
  for (const simd::Kernels* kernels : simd::AvailableKernels()) {
    const std::string set = kernels->instruction_set;
    auto* multiply_adds = &Baseline;
#ifdef __x86_64__
    if (set == "avx2") multiply_adds = &Avx2;
    if (set == "avx512") multiply_adds = &Avx512;
#endif
    benchmark::RegisterBenchmark(("FmaPeak/" + set).c_str(), FmaPeak,
                                 multiply_adds, kernels->lanes);
  }
  return true;
}();

}  // namespace
}  // namespace armcal

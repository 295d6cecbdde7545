#include <benchmark/benchmark.h>

#include <string>

#include "model/simd/kernels.h"
#include "tests/fixtures/fma_peak.h"

// The limits of the other benchmarks are flops divided by this rate, so it is
// measured in the same run.

namespace armcal {
namespace {

// Items are flops.
void FmaPeak(benchmark::State& state, const MultiplyAdds& multiply_adds) {
  for (auto _ : state) benchmark::DoNotOptimize(multiply_adds.run());
  state.SetItemsProcessed(static_cast<long>(
      static_cast<double>(state.iterations()) * multiply_adds.flops));
}

const bool registered = [] {
  for (const simd::Kernels* kernels : simd::AvailableKernels()) {
    const std::string set = kernels->instruction_set;
    benchmark::RegisterBenchmark(("FmaPeak/" + set).c_str(), FmaPeak,
                                 MultiplyAddsOf(set));
  }
  return true;
}();

}  // namespace
}  // namespace armcal

#include "model/simd/kernels.h"

#include <cstdlib>

#include "model/text/input_error.h"

namespace armcal::simd {

namespace baseline {
extern const Kernels kKernels;
}
#ifdef ARMCAL_X86
namespace avx2 {
extern const Kernels kKernels;
}
namespace avx512 {
extern const Kernels kKernels;
}
#endif

namespace {

std::vector<const Kernels*> FindAvailable() {
  std::vector<const Kernels*> found = {&baseline::kKernels};
#ifdef ARMCAL_X86
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) {
    found.push_back(&avx2::kKernels);
    if (__builtin_cpu_supports("avx512f") &&
        __builtin_cpu_supports("avx512dq") &&
        __builtin_cpu_supports("avx512vl")) {
      found.push_back(&avx512::kKernels);
    }
  }
#endif
  return found;
}

const Kernels& Choose() {
  const char* wanted = std::getenv("ARMCAL_INSTRUCTION_SET");
  if (wanted == nullptr || *wanted == '\0') return *AvailableKernels().back();
  std::string names;
  for (const Kernels* kernels : AvailableKernels()) {
    if (kernels->instruction_set == std::string(wanted)) return *kernels;
    names +=
        (names.empty() ? "" : ", ") + std::string(kernels->instruction_set);
  }
  throw InputError("ARMCAL_INSTRUCTION_SET", "", wanted,
                   "this processor has " + names);
}

}  // namespace

const std::vector<const Kernels*>& AvailableKernels() {
  static const std::vector<const Kernels*> available = FindAvailable();
  return available;
}

const Kernels& BestKernels() {
  static const Kernels& best = Choose();
  return best;
}

}  // namespace armcal::simd

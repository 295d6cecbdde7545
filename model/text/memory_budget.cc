#include "model/text/memory_budget.h"

#include <unistd.h>

#include <algorithm>
#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace armcal {

void ReturnFreedMemory() {
#ifdef __GLIBC__
  malloc_trim(0);
#endif
}

std::size_t MemoryBudget::DefaultBytes() {
  constexpr std::size_t kMost = std::size_t{3} << 28;
  const long pages = sysconf(_SC_PHYS_PAGES), size = sysconf(_SC_PAGESIZE);
  if (pages <= 0 || size <= 0) return kMost;
  return std::min(kMost, static_cast<std::size_t>(pages) * size / 8);
}

}  // namespace armcal

#include "tools/heap.h"

#include <cstdint>
#include <cstdlib>

#ifdef __GLIBC__
#include <malloc.h>
#include <sys/mman.h>
#include <unistd.h>
#endif

namespace armcal {

void PrepareHeap() {
#ifdef __GLIBC__
  constexpr int kReserved = 256 << 20, kPadding = 1 << 20;
  constexpr std::uintptr_t kLargePage = 2 << 20;
  mallopt(M_MMAP_THRESHOLD, 1 << 30);
  mallopt(M_TRIM_THRESHOLD, 1 << 30);
  // The heap grows by that much of addresses, not of memory, when it is empty.
  const auto begin = reinterpret_cast<std::uintptr_t>(sbrk(0));
  mallopt(M_TOP_PAD, kReserved);
  void* volatile taken = std::malloc(kPadding);  // or it would be left out
  std::free(taken);
  mallopt(M_TOP_PAD, kPadding);
  const auto end = reinterpret_cast<std::uintptr_t>(sbrk(0));
  const std::uintptr_t first = (begin + kLargePage - 1) / kLargePage;
  const std::uintptr_t last = end / kLargePage;
  // Without large pages it is as it was.
  if (first < last) {
    // A page is found by its number. NOLINTNEXTLINE(performance-no-int-to-ptr)
    madvise(reinterpret_cast<void*>(first * kLargePage),
            (last - first) * kLargePage, MADV_HUGEPAGE);
  }
#endif
}

}  // namespace armcal

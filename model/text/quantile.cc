#include "model/text/quantile.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <vector>

namespace armcal {
namespace {

// The highest 16 bits of a double: its power of two and 1/16 of that. Numbers
// that are not negative are in the order of their bits.
constexpr int kBuckets = 1 << 15;
int BucketOf(double x) {
  std::uint64_t bits;
  std::memcpy(&bits, &x, sizeof(bits));
  return static_cast<int>(bits >> 48) & (kBuckets - 1);
}

}  // namespace

double NonnegativeAtRank(const double* x, long count, long rank) {
  std::vector<std::int32_t> size(kBuckets, 0);
  for (long k = 0; k < count; ++k) ++size[BucketOf(x[k])];
  int bucket = 0;
  while (rank >= size[bucket]) rank -= size[bucket++];
  std::vector<double> inside;
  inside.reserve(size[bucket]);
  for (long k = 0; k < count; ++k) {
    if (BucketOf(x[k]) == bucket) inside.push_back(x[k]);
  }
  std::nth_element(inside.begin(), inside.begin() + rank, inside.end());
  return inside[rank];
}

}  // namespace armcal

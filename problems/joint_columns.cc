#include "problems/joint_columns.h"

#include <cstdint>

namespace armcal {

void JointColumns::Resize(const std::vector<int>& sizes, long rows) {
  // Columns have room for whole vectors of up to 8 lanes, so that kernels need
  // no code for a rest. Eight more doubles keep columns of a power of two from
  // falling into the same few lines of the cache.
  stride_ = (rows + 7) / 8 * 8 + 8;
  constexpr long kAlignment = 8;  // doubles, a line of the cache
  long size = kAlignment;
  for (const int columns : sizes) size += columns * stride_;
  if (static_cast<long>(room_.size()) < size) room_.resize(size);
  const auto address = reinterpret_cast<std::uintptr_t>(room_.data());
  const long ahead = static_cast<long>(address / sizeof(double)) % kAlignment;
  double* next = room_.data() + (kAlignment - ahead) % kAlignment;
  joints_.clear();
  for (const int columns : sizes) {
    joints_.push_back(next);
    next += columns * stride_;
  }
}

}  // namespace armcal

#include "model/text/kept_items.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <memory>
#include <vector>

namespace armcal::kept_items_test {

using Block = std::vector<char>;

constexpr std::size_t kBlock = 64 << 10, kBudget = 64 << 20;

// Bytes of memory that the process has.
std::size_t Resident() {
  std::size_t all = 0, resident = 0;
  std::ifstream("/proc/self/statm") >> all >> resident;
  return resident * static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
}

TEST(KeptItems, AreOfAWholePassOrNone) {
  KeptItems<Block> kept(std::make_shared<MemoryBudget>(3 * kBlock));
  const auto pass = [&](int blocks) {
    kept.Begin();
    for (int k = 0; k < blocks; ++k) {
      Block block(kBlock);
      kept.Add(&block, kBlock);
    }
    kept.End();
    return kept.whole();
  };
  EXPECT_TRUE(pass(3));
  EXPECT_EQ(kept.items().size(), 3u);
  EXPECT_FALSE(pass(4));
  EXPECT_TRUE(kept.items().empty());
  EXPECT_FALSE(pass(3)) << "the same pass again would be as large";
  kept.Forget();
  EXPECT_TRUE(pass(3));
}

#ifndef SANITIZED
// A heap keeps what is freed below what is still in use: below the block that
// did not fit.
TEST(KeptItems, GiveBackTheMemoryOfWhatDoesNotFit) {
  KeptItems<Block> kept(std::make_shared<MemoryBudget>(kBudget));
  kept.Begin();
  std::size_t most = 0;
  Block block(kBlock, 1);
  while (kept.Add(&block, kBlock) != &block) {
    most = std::max(most, Resident());
    block = Block(kBlock, 1);
  }
  EXPECT_LT(Resident(), most - kBudget / 2) << most;
}
#endif  // SANITIZED

}  // namespace armcal::kept_items_test

#include "model/text/quantile.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace armcal::quantile_test {

TEST(NonnegativeAtRank, IsThatOfTheSortedNumbers) {
  std::mt19937_64 random(2);
  std::vector<double> x = {0, 0, -0., 1e-320,
                           std::numeric_limits<double>::infinity()};
  for (int k = 0; k < 3000; ++k) {
    const double size = std::ldexp(1 + 1e-3 * (random() % 900),
                                   static_cast<int>(random() % 30) - 15);
    x.push_back(k % 3 == 0 ? 1.25 : size);
  }
  std::vector<double> sorted = x;
  std::sort(sorted.begin(), sorted.end());
  const long count = static_cast<long>(x.size());
  for (long rank = 0; rank < count; rank += rank < 10 ? 1 : 13) {
    EXPECT_EQ(NonnegativeAtRank(x.data(), count, rank), sorted[rank]) << rank;
  }
  EXPECT_EQ(NonnegativeAtRank(x.data(), 1, 0), 0);
}

}  // namespace armcal::quantile_test

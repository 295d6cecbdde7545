#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "tests/calib/linear/spoiled_torque.h"

namespace armcal::torque_outliers_long_test {

// The first of the seeds: ARMCAL_SEED, or 1.
int FirstSeed() {
  const char* seed = std::getenv("ARMCAL_SEED");
  return seed != nullptr ? std::atoi(seed) : 1;
}

// Losing 5 % of the samples alone moves estimates by sqrt(.05 / .95) = .23
// standard deviations, and the largest of some 60 by almost 1.
TEST(TorqueOutliers, OverManyLogs) {
  constexpr int kRuns = 12;
  double squares = 0, worst_rms = 0, recall = 0, precision = 0;
  int beyond = 0, logs = 0;
  for (const char* name : {"UR5 6R", "PUMA560 6R"}) {
    for (int k = 0; k < kRuns; ++k) {
      const Outcome o = Compare(Record(name, FirstSeed() + k));
      squares += o.rms * o.rms;
      worst_rms = std::max(worst_rms, o.rms);
      recall += o.recall;
      precision += o.precision;
      beyond += o.largest > 1;
      ++logs;
      EXPECT_GE(o.squared_rms, 4);
      EXPECT_GE(o.recall, .99);
      EXPECT_GE(o.precision, .99);
      EXPECT_EQ(o.listed_of_clean, 0u);
    }
  }
  std::printf(
      "%d logs: moves %.3f rms, %.3f in the worst log; a parameter beyond 1 in "
      "%d; recall %.4f, precision %.4f\n",
      logs, std::sqrt(squares / logs), worst_rms, beyond, recall / logs,
      precision / logs);
  EXPECT_LE(worst_rms, .35);
  EXPECT_EQ(beyond, 0);
}

}  // namespace armcal::torque_outliers_long_test

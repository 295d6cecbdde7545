#include "calib/inspect/equal_rows.h"

#include <gtest/gtest.h>

#include <cmath>

namespace armcal::equal_rows_test {

using Eigen::VectorXd;

TEST(EqualRows, AreRunsOfOneValue) {
  const VectorXd x = (VectorXd(7) << 1, 1, 2, 3, 3, 3, 1).finished();
  const std::vector<EqualRows> runs =
      RunsOfEqualRows(x, std::vector<bool>(7, true));
  ASSERT_EQ(runs.size(), 4u);
  EXPECT_EQ(runs[0].repeats, 1);
  EXPECT_EQ(runs[1].repeats, 0);
  EXPECT_EQ(runs[2].begin, 3);
  EXPECT_EQ(runs[2].end, 6);
  EXPECT_EQ(runs[2].repeats, 2);
}

// A run of which some rows count is one, with the repeats among these.
TEST(EqualRows, OfRowsThatDoNotCountThereAreNone) {
  const VectorXd x = (VectorXd(6) << 1, 1, 2, 2, 2, 2).finished();
  const std::vector<EqualRows> runs =
      RunsOfEqualRows(x, {false, false, false, true, true, true});
  ASSERT_EQ(runs.size(), 1u);
  EXPECT_EQ(runs[0].begin, 2);
  EXPECT_EQ(runs[0].repeats, 2);
}

// Of 101 runs, 100 with at most 2 repeats, e^-15 as long as 2 (1 + 15 / log
// 101) = 8.5 repeats are expected by the law of the others.
TEST(EqualRows, AreTooLongWhereChanceHasNoneSoLong) {
  for (const int repeats : {8, 9}) {
    std::vector<EqualRows> runs(100);
    for (size_t k = 0; k < runs.size(); ++k) {
      runs[k].repeats = static_cast<int>(k % 3);
    }
    runs.push_back({500, 501 + repeats, repeats});
    const std::vector<EqualRows> found = TooLongForChance(runs, 15);
    ASSERT_EQ(found.size(), repeats == 9 ? 1u : 0u);
    if (repeats == 9) EXPECT_EQ(found[0].begin, 500);
  }
}

// Two long ones are told beside the longest of the others, not beside each
// other.
TEST(EqualRows, TwoAreToldTogether) {
  std::vector<EqualRows> runs(200);
  runs.push_back({500, 551, 50});
  runs.push_back({700, 749, 48});
  EXPECT_EQ(TooLongForChance(runs, 15).size(), 2u);
}

}  // namespace armcal::equal_rows_test

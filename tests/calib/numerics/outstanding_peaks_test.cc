#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "calib/numerics/maxima.h"

namespace armcal::outstanding_test {

// Five of 1 to 2 above the threshold of 1, and one of 21: (1 + 20 / 1.5)^-4,
// five times, and one that stands out is half of the questions.
TEST(ChancesAmongPeaks, AreLomaxs) {
  const std::vector<double> chances =
      ChancesAmongPeaks({1, 21, 1.2, 1.3, 1.4, 1.6});
  EXPECT_NEAR(chances[1], 2 * 5 * std::pow(1 + 20 / 1.5, -4), 1e-12);
  EXPECT_EQ(chances[0], 1);
}

// Two of 20 and more above the threshold: by itself one of five, a pair one of
// 15, (1 + 20 / 1.5)^-4 and (1 + 40 / 1.5)^-4; a quarter of the questions.
TEST(ChancesAmongPeaks, AreTheLargestOfAllGroupsOfThem) {
  const std::vector<double> chances =
      ChancesAmongPeaks({1, 21, 1.2, 1.3, 1.4, 1.6, 60});
  const double alone = 5 * std::pow(1 + 20 / 1.5, -4);
  const double pair = 15 * std::pow(1 + 40 / 1.5, -4);
  EXPECT_NEAR(chances[1], 4 * std::max(alone, pair), 1e-12);
}

TEST(ChancesAmongPeaks, OfSeveralThatStandOut) {
  const std::vector<double> chances =
      ChancesAmongPeaks({1, 21, 1.2, 1.3, 1.4, 1.6, 23, 22});
  for (const int k : {1, 6, 7}) EXPECT_LT(chances[k], .01) << k;
}

TEST(ChancesAmongPeaks, AreOneWhereFewTell) {
  for (const double chance : ChancesAmongPeaks({1, 2, 3, 100})) {
    EXPECT_EQ(chance, 1);
  }
  EXPECT_TRUE(ChancesAmongPeaks({}).empty());
}

// No exponential peak is called improbable more often than it is, whether or
// not there are others beside it that are none.
TEST(ChancesAmongPeaks, AreNoLargerThanTrue) {
  std::mt19937_64 random(3);
  std::exponential_distribution<double> peak(.4);
  constexpr int kDraws = 20000;
  for (const int peaks : {5, 14, 30}) {
    for (const int others : {0, 1, 2, 5}) {
      int passed = 0;
      for (int i = 0; i < kDraws; ++i) {
        std::vector<double> sizes(peaks + others, 200);
        for (int k = 0; k < peaks; ++k) sizes[k] = 3 + peak(random);
        const std::vector<double> chances = ChancesAmongPeaks(sizes);
        passed +=
            *std::min_element(chances.begin(), chances.begin() + peaks) < .02;
      }
      EXPECT_LT(passed, .02 * kDraws) << peaks << ", " << others;
    }
  }
}

// Two-sided tails of the normal distribution, three and four standard
// deviations: .0027 and 6.334e-5.
TEST(ChanceOfLargest, IsOfTheLargestInItsDeviations) {
  const Eigen::Vector2d stddev(.1, 10);
  EXPECT_NEAR(ChanceOfLargest(Eigen::Vector2d(.3, -5), stddev, 5),
              10 * 2.6998e-3, 1e-5);
  EXPECT_NEAR(ChanceOfLargest(Eigen::Vector2d(.3, -40), stddev, 5),
              10 * 6.3342e-5, 1e-7);
}

TEST(ChanceOfLargest, IsAtMostOne) {
  const Eigen::Vector2d stddev(.1, 0);
  EXPECT_EQ(ChanceOfLargest(Eigen::Vector2d(.1, 5), stddev, 100), 1);
  EXPECT_EQ(ChanceOfLargest(Eigen::Vector2d(0, 5), stddev, 1), 1);
}

}  // namespace armcal::outstanding_test

#include "calib/numerics/robust_rows.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/fixtures/sample_motion.h"
#include "tests/fixtures/sample_robots.h"

namespace armcal::robust_rows_test {

TEST(ResidualStatistics, SpreadIsThatOfNormalErrors) {
  for (const double sigma : {1e-9, 1., 1e9}) {
    std::mt19937_64 random(2);
    ResidualStatistics statistics;
    for (int k = 0; k < 100000; ++k) statistics.Add(sigma * Normal(&random));
    EXPECT_NEAR(statistics.RobustSpread() / sigma, 1, .015) << sigma;
    EXPECT_EQ(statistics.count(), 100000);
  }
}

TEST(ResidualStatistics, SpreadIsTheMedianToHalfAPercent) {
  std::mt19937_64 random(3);
  ResidualStatistics statistics;
  std::vector<double> sizes;
  for (int k = 0; k < 1001; ++k) {
    const double r = std::pow(Normal(&random), 5);
    statistics.Add(r);
    sizes.push_back(std::abs(r));
  }
  std::sort(sizes.begin(), sizes.end());
  EXPECT_NEAR(statistics.RobustSpread() / (1.4826 * sizes[500]), 1, .005);
}

TEST(ResidualStatistics, SpreadIgnoresOutliers) {
  std::mt19937_64 random(4);
  ResidualStatistics statistics;
  for (int k = 0; k < 100000; ++k) {
    statistics.Add(k % 50 == 0 ? 1e6 : Normal(&random));
  }
  EXPECT_NEAR(statistics.RobustSpread(), 1, .05);
  // |r| > 2 * 1.345 has probability .00715 among the 98000 others.
  EXPECT_NEAR(statistics.outliers(), 2000 + 700, 100);
}

TEST(ResidualStatistics, EmptyAndZero) {
  ResidualStatistics statistics;
  EXPECT_EQ(statistics.RobustSpread(), 0);
  EXPECT_EQ(statistics.Autocorrelation(), 0);
  for (int k = 0; k < 10; ++k) statistics.Add(0);
  EXPECT_LT(statistics.RobustSpread(), 1e-11);
  EXPECT_EQ(statistics.Autocorrelation(), 0);
}

TEST(ResidualStatistics, AutocorrelationOfAutoregression) {
  for (const double rho : {-.5, 0., .5, .9}) {
    std::mt19937_64 random(5);
    ResidualStatistics statistics;
    double x = 0;
    for (int k = 0; k < 200000; ++k) {
      x = rho * x + std::sqrt(1 - rho * rho) * Normal(&random);
      statistics.Add(x);
    }
    // Clipping at 1.345 costs some of it.
    EXPECT_NEAR(statistics.Autocorrelation(), rho, .04) << rho;
  }
}

TEST(ResidualStatistics, AutocorrelationDoesNotReachAcrossBreaks) {
  ResidualStatistics apart, together;
  for (int k = 0; k < 100; ++k) {
    apart.Add(1);
    together.Add(1);
    apart.Break();
  }
  EXPECT_EQ(apart.Autocorrelation(), 0);
  EXPECT_NEAR(together.Autocorrelation(), .99, 1e-12);
}

}  // namespace armcal::robust_rows_test

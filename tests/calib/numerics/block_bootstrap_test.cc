#include "calib/numerics/block_bootstrap.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace armcal::block_bootstrap_test {

// `size` normal values in runs of `run`, the first of which is cut anywhere.
std::vector<double> Runs(int size, int run, std::mt19937_64* random) {
  std::normal_distribution<double> normal;
  const int phase = static_cast<int>((*random)() % run);
  std::vector<double> series;
  for (int k = 0; k < size; ++k) {
    const bool begins = k == 0 || (k + phase) % run == 0;
    series.push_back(begins ? normal(*random) : series.back());
  }
  return series;
}

// rho_k = 1 - k / L up to L, which sums to 1 + (L - 1) = L.
TEST(CorrelationTime, OfRunsIsTheirLength) {
  std::mt19937_64 random(1);
  for (const int run : {1, 3, 6}) {
    EXPECT_NEAR(CorrelationTime(Runs(20'000, run, &random)), run, .15 * run);
  }
}

// rho_k = a^k: (1 + a) / (1 - a), of ranks slightly less.
TEST(CorrelationTime, OfAnAutoregression) {
  std::mt19937_64 random(2);
  std::normal_distribution<double> normal;
  std::vector<double> series = {0};
  for (int k = 1; k < 20'000; ++k) {
    series.push_back(.8 * series.back() + normal(random));
  }
  EXPECT_NEAR(CorrelationTime(series), 9, 1.5);
}

TEST(CorrelationTime, CountsNeitherScaleNorInfiniteValues) {
  std::mt19937_64 random(3);
  std::vector<double> series = Runs(500, 4, &random);
  const double time = CorrelationTime(series);
  for (double& x : series) x = std::exp(9 * x);
  EXPECT_EQ(CorrelationTime(series), time);
  *std::max_element(series.begin(), series.end()) =
      std::numeric_limits<double>::infinity();
  EXPECT_NEAR(CorrelationTime(series), time, .05 * time);
  EXPECT_EQ(CorrelationTime({2, 2, 2, 2}), 1);
  EXPECT_EQ(CorrelationTime({}), 1);
}

TEST(BootstrapBlock, AtLeastTheCubeRoot) {
  EXPECT_EQ(BootstrapBlock(1000, 1), 10);
  EXPECT_EQ(BootstrapBlock(1000, 7.2), 15);
  EXPECT_EQ(BootstrapBlock(30, 1), 3);
  EXPECT_EQ(BootstrapBlock(8, 30), 8);
}

// The mean of independent normal values, 25 blocks of 4: +- t_24 / sqrt(100).
TEST(BlockBootstrap, MeanByStudent) {
  std::mt19937_64 random(5);
  double width = 0;
  for (int trial = 0; trial < 50; ++trial) {
    const std::vector<double> x = Runs(100, 1, &random);
    const BootstrapInterval interval =
        BlockBootstrap(100, 4, trial, [&x](const std::vector<int>& chosen) {
          double sum = 0;
          for (const int k : chosen) sum += x[k];
          return sum / 100;
        });
    width += (interval.high - interval.low) / 50;
  }
  EXPECT_NEAR(width, 2 * 2.064 / 10, .07 * .41);
}

}  // namespace armcal::block_bootstrap_test

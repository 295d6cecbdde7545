#include "calib/robust_rows.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/sample_motion.h"
#include "tests/sample_robots.h"

namespace armcal {
namespace {

// The mean of f over standard normal errors, by the midpoint rule.
template <class F>
double NormalMean(const F& f) {
  constexpr double kStep = 1e-4;
  double sum = 0;
  for (int k = -100000; k < 100000; ++k) {
    const double r = (k + .5) * kStep;
    sum += f(r) * std::exp(-r * r / 2);
  }
  return sum * kStep / std::sqrt(2 * M_PI);
}

double Score(double r) { return r * Huber::Weight(r); }

// Huber (1964), Holland and Welsch (1977): 95 % efficient at 1.345.
TEST(Huber, IsNinetyFivePercentEfficient) {
  const double slope =
      NormalMean([](double r) { return Huber::Inside(r) ? 1. : 0.; });
  const double square =
      NormalMean([](double r) { return Score(r) * Score(r); });
  EXPECT_NEAR(slope * slope / square, .95, 5e-4);
}

TEST(Huber, InsideIsTheSlopeOfTheScore) {
  for (const double r : {-9., -1.4, -1.3, -.1, 0., .1, 1.3, 1.4, 9.}) {
    const double slope = (Score(r + 1e-6) - Score(r - 1e-6)) / 2e-6;
    EXPECT_NEAR(slope, Huber::Inside(r) ? 1 : 0, 1e-6) << r;
    EXPECT_LE(std::abs(Score(r)), 1.345 + 1e-15);
  }
}

// A location estimated by iterated weights, against the mean.
TEST(Huber, CostsLittleOnNormalErrorsAndResistsOutliers) {
  std::mt19937_64 random(1);
  constexpr int kCount = 100, kRuns = 4000;
  double mean_squares = 0, huber_squares = 0, outlier_squares = 0;
  const auto location = [](const std::vector<double>& r) {
    double at = 0;
    for (int pass = 0; pass < 20; ++pass) {
      double sum = 0, weights = 0;
      for (const double x : r) {
        sum += x * Huber::Weight(x - at);
        weights += Huber::Weight(x - at);
      }
      at = sum / weights;
    }
    return at;
  };
  for (int run = 0; run < kRuns; ++run) {
    std::vector<double> r(kCount);
    double mean = 0;
    for (double& x : r) mean += (x = Normal(&random)) / kCount;
    mean_squares += mean * mean;
    huber_squares += std::pow(location(r), 2);
    r[0] = r[1] = 1000;
    outlier_squares += std::pow(location(r), 2);
  }
  EXPECT_NEAR(std::sqrt(huber_squares / mean_squares), 1 / std::sqrt(.95), .01);
  EXPECT_LT(std::sqrt(outlier_squares / mean_squares), 1.15);
}

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

}  // namespace
}  // namespace armcal

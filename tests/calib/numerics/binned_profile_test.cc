#include "calib/numerics/binned_profile.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace armcal::binned_profile_test {

std::vector<double> RandomPlaces() {
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal(-2, 5);
  std::vector<double> places(3000);
  for (double& x : places) x = normal(random);
  return places;
}

BinnedProfile ProfileOf(const std::vector<double>& places) {
  BinnedProfile profile(2, 40);
  for (const double x : places) {
    profile.Add(x, Eigen::Vector2d(std::sin(x), x));
  }
  return profile;
}

// Against sums over the samples of each bin, taken one by one.
TEST(BinnedProfile, HoldsMeanAndRmsOfTheSamplesInEachBin) {
  const std::vector<double> places = RandomPlaces();
  const BinnedProfile profile = ProfileOf(places);
  EXPECT_LE(profile.size(), 40);
  EXPECT_GE(profile.size(), 19);
  long seen = 0;
  for (int k = 0; k < profile.size(); ++k) {
    const double begin = profile.begin() + k * profile.width();
    double sum = 0, squares = 0;
    long samples = 0;
    for (const double x : places) {
      if (x < begin || x >= begin + profile.width()) continue;
      sum += std::sin(x), squares += x * x, ++samples;
    }
    ASSERT_EQ(profile.samples(k), samples) << k;
    seen += samples;
    if (samples == 0) continue;
    EXPECT_NEAR(profile.Mean(k)[0], sum / samples, 1e-12);
    EXPECT_NEAR(profile.Rms(k)[1], std::sqrt(squares / samples), 1e-12);
  }
  EXPECT_EQ(seen, 3000);
}

TEST(BinnedProfile, BinsDoNotDependOnTheOrder) {
  std::vector<double> places = RandomPlaces();
  const BinnedProfile one = ProfileOf(places);
  std::sort(places.begin(), places.end());
  const BinnedProfile other = ProfileOf(places);
  ASSERT_EQ(one.size(), other.size());
  EXPECT_EQ(one.begin(), other.begin());
  EXPECT_EQ(one.width(), other.width());
  for (int k = 0; k < one.size(); ++k) {
    EXPECT_EQ(one.samples(k), other.samples(k));
  }
}

// A joint that never moves, and a coordinate far from zero: one bin.
TEST(BinnedProfile, StandsWhatHardlyVaries) {
  BinnedProfile profile(1, 40);
  for (int k = 0; k < 5; ++k) profile.Add(1.7e9, Eigen::VectorXd::Ones(1));
  EXPECT_EQ(profile.size(), 1);
  EXPECT_EQ(profile.samples(0), 5);
  profile.Add(-1e300, Eigen::VectorXd::Ones(1));
  EXPECT_LE(profile.size(), 40);
}

}  // namespace armcal::binned_profile_test

#include "calib/diagnose/candidates/search.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/fixtures/sample_motion.h"

namespace armcal::search_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kSamples = 2000;
constexpr double kRange = 2.4;  // rad
constexpr double kResolution = M_PI / kRange;

// A joint that goes to and fro.
VectorXd Position() {
  const VectorXd t = VectorXd::LinSpaced(kSamples, 0, 40);
  return kRange / 2 * (.9 * t.array()).sin();
}

VectorXd Noise(std::mt19937_64* random, double sigma) {
  MatrixXd x = MatrixXd::Zero(kSamples, 1);
  AddNoise(random, VectorXd::Constant(1, sigma), &x);
  return x;
}

TEST(PeakFrequencies, AreWhereTheResidualHasLines) {
  std::mt19937_64 random(1);
  const VectorXd q = Position();
  for (const double w : {9., 31.7, 96.3}) {
    const VectorXd residual =
        (w * q.array() + .7).sin().matrix() + Noise(&random, 1);
    const auto peaks = PeakFrequencies(residual, q, 6, 130, 3);
    ASSERT_FALSE(peaks.empty());
    EXPECT_NEAR(peaks[0], w, kResolution / 4);
  }
}

TEST(PeakFrequencies, TheHighestComesFirst) {
  const VectorXd q = Position();
  const VectorXd residual = (30 * q.array()).sin() + 2 * (70 * q.array()).cos();
  const auto peaks = PeakFrequencies(residual, q, 6, 130, 2);
  ASSERT_EQ(peaks.size(), 2u);
  EXPECT_NEAR(peaks[0], 70, kResolution / 4);
  EXPECT_NEAR(peaks[1], 30, kResolution / 2);
}

// A line of 17 Hz beside motion that is a hundred times as large.
TEST(PowerOverNeighbours, IsLargeAtALineOnly) {
  const VectorXd t = VectorXd::LinSpaced(4000, 0, 40);
  const VectorXd motion = 20 * (2 * M_PI * .7 * t.array()).sin();
  const VectorXd line = .2 * (2 * M_PI * 17 * t.array()).cos();
  std::mt19937 random(3);
  VectorXd noise(t.size());
  std::normal_distribution<double> normal;
  for (double& x : noise) x = normal(random);
  const VectorXd signal = motion + line + noise;
  EXPECT_GT(PowerOverNeighbours(signal, t, 17), 20);
  EXPECT_LT(PowerOverNeighbours(signal, t, 8), 10);
  EXPECT_LT(PowerOverNeighbours(signal, t, 25), 10);
}

TEST(AmplitudeAt, IsThatOfTheWave) {
  const VectorXd t = VectorXd::LinSpaced(4000, 0, 40);
  const VectorXd waves = 20 * (2 * M_PI * .7 * t.array()).sin() +
                         .2 * (2 * M_PI * 17 * t.array() + 1).cos() + 5;
  EXPECT_NEAR(AmplitudeAt(waves, t, .7), 20, .2);
  EXPECT_NEAR(AmplitudeAt(waves, t, 17), .2, .002);
  EXPECT_NEAR(AmplitudeAt(waves, t, 11), 0, .002);
}

TEST(PeakFrequencies, AreNoneWithoutMotionOrRange) {
  const VectorXd still = VectorXd::Ones(kSamples);
  EXPECT_TRUE(PeakFrequencies(still, still, 6, 130, 3).empty());
  EXPECT_TRUE(PeakFrequencies(still, Position(), 130, 6, 3).empty());
  EXPECT_TRUE(PeakFrequencies({}, {}, 6, 130, 3).empty());
}

// A push of 0.4 s on two of three joints, in unit noise.
class StrongWindowsTest : public testing::Test {
 protected:
  StrongWindowsTest() : residual_(kSamples, 3) {
    for (int j = 0; j < 3; ++j) residual_.col(j) = Noise(&random_, 1);
  }
  void Push(double centre, double force) {
    for (int k = 0; k < kSamples; ++k) {
      const double u = (t_[k] - centre) / .2;
      const double shape = std::abs(u) < 1 ? std::pow(1 - u * u, 2) : 0;
      residual_(k, 0) += force * shape;
      residual_(k, 2) -= force * shape;
    }
  }

  std::mt19937_64 random_{2};
  VectorXd t_ = VectorXd::LinSpaced(kSamples, 3, 43);
  MatrixXd residual_;
};

TEST_F(StrongWindowsTest, AreWhereThePushesWere) {
  Push(12.3, 4);
  Push(30.1, 3);
  int searched;
  const auto windows = StrongWindows(residual_, t_, {.4, 1}, 2, &searched);
  ASSERT_EQ(windows.size(), 4u);
  for (int k : {0, 2}) {
    EXPECT_EQ(windows[k].duration, k == 0 ? .4 : 1);
    EXPECT_NEAR(windows[k].centre, 12.3, k == 0 ? .1 : .25);
    EXPECT_NEAR(windows[k + 1].centre, 30.1, k == 0 ? .1 : .25);
  }
}

// A quarter of a duration apart, over 40 s.
TEST_F(StrongWindowsTest, AreCountedAsTheyAreSearched) {
  int searched = 0;
  StrongWindows(residual_, t_, {.4}, 1, &searched);
  EXPECT_NEAR(searched, 400, 1);
  StrongWindows(residual_, t_, {.4, 2}, 1, &searched);
  EXPECT_NEAR(searched, 400 + 80, 2);
}

// The same push is not named twice.
TEST_F(StrongWindowsTest, AreHalfADurationApart) {
  Push(12.3, 20);
  int searched;
  const auto windows = StrongWindows(residual_, t_, {1}, 3, &searched);
  ASSERT_EQ(windows.size(), 3u);
  for (int a = 0; a < 3; ++a) {
    for (int b = 0; b < a; ++b) {
      EXPECT_GE(std::abs(windows[a].centre - windows[b].centre), .5 - 1e-9);
    }
  }
}

}  // namespace armcal::search_test

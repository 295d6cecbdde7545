#include "model/plant/sensors.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <vector>

namespace armcal::sensors_test {

using Eigen::VectorXd;

TEST(Encoders, RoundToTheirResolutionAfterNoise) {
  SensorOptions options;
  options.encoder_resolution = VectorXd::Constant(2, .01);
  Encoders exact(options, 2);
  const VectorXd q = Eigen::Vector2d(.1234, -.5678);
  EXPECT_NEAR(exact.Measure(q)[0], .12, 1e-12);
  EXPECT_NEAR(exact.Measure(q)[1], -.57, 1e-12);
  options.encoder_resolution = VectorXd();
  options.encoder_noise = Eigen::Vector2d(.1, .3);
  Encoders noisy(options, 2);
  VectorXd squares = VectorXd::Zero(2);
  for (int k = 0; k < 10000; ++k) {
    squares += (noisy.Measure(q) - q).cwiseAbs2();
  }
  EXPECT_NEAR(std::sqrt(squares[0] / 10000), .1, .003);
  EXPECT_NEAR(std::sqrt(squares[1] / 10000), .3, .009);
}

// Noise of standard deviations s (white) and c (correlated over T): at lag dt
// its autocovariance is c^2 exp(-dt / T).
TEST(TorqueNoise, HasItsSpreadAndCorrelation) {
  SensorOptions options;
  options.torque_noise = VectorXd::Constant(1, .5);
  options.coloured_noise = VectorXd::Constant(1, 2);
  options.noise_correlation = .02;
  TorqueNoise noise(options, 1);
  const int count = 200000;
  std::vector<double> x(count);
  for (double& value : x) value = noise.Next(.004)[0];
  double variance = 0, lagged = 0;
  for (int k = 5; k < count; ++k) {
    variance += x[k] * x[k] / count;
    lagged += x[k] * x[k - 5] / count;
  }
  EXPECT_NEAR(variance, .25 + 4, .15);
  EXPECT_NEAR(lagged, 4 * std::exp(-1), .12);
}

std::vector<long> Sampled(const SensorOptions& options, int periods,
                          long ticks) {
  SamplingClock clock(options, periods, 1000);
  std::vector<long> sampled;
  for (long tick = 0; tick < ticks; ++tick) {
    if (clock.Samples(tick)) sampled.push_back(tick);
  }
  return sampled;
}

TEST(SamplingClock, IsRegularByDefault) {
  const std::vector<long> ticks = Sampled({}, 4, 4001);
  ASSERT_EQ(ticks.size(), 1001u);
  for (size_t k = 0; k < ticks.size(); ++k) {
    EXPECT_EQ(ticks[k], 4 * static_cast<long>(k));
  }
}

TEST(SamplingClock, LosesTheShareThatIsAskedFor) {
  SensorOptions options;
  options.lost_share = .4;
  EXPECT_NEAR(1 - Sampled(options, 4, 400000).size() / 100000., .4, .01);
  options.lost_share = .1;
  const std::vector<long> ticks = Sampled(options, 4, 400000);
  EXPECT_NEAR(1 - ticks.size() / 100000., .1, .005);
  std::set<long> gaps;
  for (size_t k = 1; k < ticks.size(); ++k) {
    gaps.insert((ticks[k] - ticks[k - 1]) / 4);
  }
  EXPECT_EQ(*gaps.begin(), 1);
  EXPECT_GE(gaps.size(), 5u);
}

TEST(SamplingClock, JitterMovesSamplesAndTimeRises) {
  SensorOptions options;
  options.jitter = .002;  // 2 periods
  const std::vector<long> ticks = Sampled(options, 10, 100000);
  double squares = 0;
  for (size_t k = 1; k < ticks.size(); ++k) {
    ASSERT_GT(ticks[k], ticks[k - 1]);
    squares += std::pow(ticks[k] - 10. * k, 2);
  }
  EXPECT_NEAR(ticks.size(), 10000, 1);
  EXPECT_NEAR(std::sqrt(squares / ticks.size()), 2, .1);
}

}  // namespace armcal::sensors_test

#include "calib/numerics/power_spectrum.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/fixtures/sample_motion.h"

namespace armcal::power_spectrum_test {

constexpr double kStep = .004;

// White noise of standard deviation s has a one-sided density of 2 s^2 dt.
TEST(PowerSpectrum, WhiteNoiseIsFlat) {
  std::mt19937_64 random(3);
  PowerSpectrum spectrum(2, kStep);
  for (int k = 0; k < 100'000; ++k) {
    const double a = 3 * Normal(&random), b = Normal(&random);
    spectrum.Add(Eigen::Vector2d(a, b));
  }
  const Eigen::MatrixXd density = spectrum.Density().middleRows(4, 240);
  EXPECT_NEAR(density.col(0).mean() / (2 * 9 * kStep), 1, .02);
  EXPECT_NEAR(density.col(1).mean() / (2 * 1 * kStep), 1, .02);
  EXPECT_NEAR(density.col(1).head(120).mean() / density.col(1).tail(120).mean(),
              1, .05);
}

// A sine of amplitude A has its power A^2 / 2 about its frequency.
TEST(PowerSpectrum, ASineIsAtItsFrequency) {
  PowerSpectrum spectrum(1, kStep);
  constexpr double kFrequency = 31.3;
  for (int k = 0; k < 5000; ++k) {
    spectrum.Add(Eigen::VectorXd::Constant(
        1, 5 + 2 * std::sin(2 * M_PI * kFrequency * kStep * k)));
  }
  const Eigen::VectorXd f = spectrum.Frequencies();
  const Eigen::VectorXd density = spectrum.Density().col(0);
  Eigen::Index peak;
  density.maxCoeff(&peak);
  EXPECT_NEAR(f[peak], kFrequency, f[1]);
  EXPECT_NEAR(density.sum() * f[1], 2, .01);
}

TEST(PowerSpectrum, WindowsDoNotReachOverGaps) {
  PowerSpectrum spectrum(1, kStep);
  for (int k = 0; k < 1000; ++k) {
    if (k % 500 == 0) spectrum.Break();
    spectrum.Add(Eigen::VectorXd::Ones(1));
  }
  EXPECT_TRUE(spectrum.empty());
}

}  // namespace armcal::power_spectrum_test

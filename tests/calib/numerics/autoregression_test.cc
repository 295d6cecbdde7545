#include "calib/numerics/autoregression.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/fixtures/sample_motion.h"

namespace armcal::autoregression_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// x_t = a1 x_{t-1} + a2 x_{t-2} + e_t.
constexpr double kA1 = 1.1, kA2 = -.5, kSigma = .7;

// Its variance, in closed form.
double StddevOfAr2() {
  return kSigma * std::sqrt((1 - kA2) /
                            ((1 + kA2) * (std::pow(1 - kA2, 2) - kA1 * kA1)));
}

VectorXd Ar2(std::mt19937_64* random, int size) {
  constexpr int kForget = 200;
  VectorXd x = VectorXd::Zero(size + kForget);
  for (int k = 2; k < x.size(); ++k) {
    x[k] = kA1 * x[k - 1] + kA2 * x[k - 2] + kSigma * Normal(random);
  }
  return x.tail(size);
}

double Correlation(const VectorXd& x, int lag) {
  const int size = static_cast<int>(x.size()) - lag;
  return x.head(size).dot(x.tail(size)) / x.squaredNorm();
}

// The process is known, as far as windows of 64 samples tell it.
void ExpectAr2(const Autoregression& noise, std::mt19937_64* random) {
  EXPECT_NEAR(noise.stddev() / StddevOfAr2(), 1, .06);
  const VectorXd white = noise.Whiten(Ar2(random, 20000));
  EXPECT_NEAR(std::sqrt(white.squaredNorm() / white.size()), 1, .06);
  for (int lag = 1; lag <= 6; ++lag) {
    EXPECT_NEAR(Correlation(white, lag), 0, .06) << lag;
  }
}

TEST(Autoregression, StddevIsThatOfTheProcess) {
  Autoregression noise;
  noise.sigma = 2;
  EXPECT_NEAR(noise.stddev(), 2, 1e-12);
  noise.a[0] = .8;
  EXPECT_NEAR(noise.stddev(), 2 / .6, 1e-9);
  noise.a << kA1, kA2, 0, 0;
  noise.sigma = kSigma;
  EXPECT_NEAR(noise.stddev(), StddevOfAr2(), 1e-9);
}

// White noise beside white noise, and beside a process of two terms.
TEST(Autoregression, PlusWhiteIsTheirSum) {
  Autoregression noise;
  noise.sigma = 3;
  const Autoregression white = PlusWhite(noise, 4);
  EXPECT_NEAR(white.sigma, 5, 1e-4);
  EXPECT_LT(white.a.norm(), 1e-6);
  noise.a << kA1, kA2, 0, 0;
  noise.sigma = kSigma;
  std::mt19937_64 random(5);
  VectorXd x = Ar2(&random, 20000);
  for (double& value : x) value += .5 * Normal(&random);
  const Autoregression sum = PlusWhite(noise, .5);
  EXPECT_NEAR(sum.stddev(), std::hypot(StddevOfAr2(), .5), .02);
  const VectorXd left = sum.Whiten(x);
  EXPECT_NEAR(std::sqrt(left.squaredNorm() / left.size()), 1, .02);
  for (int lag = 1; lag <= 6; ++lag) {
    EXPECT_NEAR(Correlation(left, lag), 0, .04) << lag;
  }
}

TEST(Autoregression, WhitenTakesOutWhatThePastSays) {
  Autoregression noise;
  noise.sigma = 2;
  noise.a << .5, 0, 0, .25;
  MatrixXd x(6, 2);
  x << 1, 0, 2, 0, 3, 0, 4, 0, 5, 8, 6, 0;
  // (5 - .5 4 - .25 1) / 2, (6 - .5 5 - .25 2) / 2.
  MatrixXd white(2, 2);
  white << 1.375, 4, 1.5, -2;
  EXPECT_TRUE(noise.Whiten(x).isApprox(white, 1e-12)) << noise.Whiten(x);
}

TEST(Autoregression, AKnownProcessIsFound) {
  std::mt19937_64 random(1);
  ExpectAr2(FitAutoregression({Ar2(&random, 20000)}, false), &random);
}

TEST(Autoregression, ManyShortStretchesAreAsGood) {
  std::mt19937_64 random(2);
  std::vector<VectorXd> stretches;
  for (int k = 0; k < 200; ++k) stretches.push_back(Ar2(&random, 100));
  ExpectAr2(FitAutoregression(stretches, false), &random);
}

TEST(Autoregression, WhereAJointRestedIsNoNoise) {
  std::mt19937_64 random(3);
  std::vector<VectorXd> stretches;
  for (int k = 0; k < 60; ++k) {
    stretches.push_back(Ar2(&random, 400).array() + 20 * Normal(&random));
  }
  ExpectAr2(FitAutoregression(stretches, true), &random);
  EXPECT_GT(FitAutoregression(stretches, false).stddev(), 1.5 * StddevOfAr2());
}

// A line of three times the noise's variance, at worst between two frequencies
// of the windows, would double the standard deviation, and so would a
// disturbance of twenty-five times it in a tenth of the time.
TEST(Autoregression, LinesAndBurstsDoNotCount) {
  std::mt19937_64 random(4);
  VectorXd x = Ar2(&random, 20000);
  const VectorXd t = VectorXd::LinSpaced(x.size(), 0, x.size() - 1);
  const VectorXd line =
      StddevOfAr2() * std::sqrt(6) * (2 * M_PI * 13.5 / 64 * t.array()).sin();
  const double with_line =
      FitAutoregression({VectorXd(x + line)}, false).stddev();
  EXPECT_NEAR(with_line / StddevOfAr2(), 1, .25);
  for (int begin = 0; begin < x.size(); begin += 4000) {
    x.segment(begin, 400) *= 5;
  }
  EXPECT_GT(std::sqrt(x.squaredNorm() / x.size()), 1.7 * StddevOfAr2());
  const double with_bursts = FitAutoregression({x}, false).stddev();
  EXPECT_NEAR(with_bursts / StddevOfAr2(), 1, .15);
}

// Whether the windows are even or odd in number, on the average of many logs;
// medians over neighbouring frequencies are a little below the mean.
TEST(Autoregression, AFewStretchesGiveTheVariance) {
  constexpr int kRuns = 400;
  std::mt19937_64 random(5);
  for (int count = 3; count <= 8; ++count) {
    double variance = 0;
    for (int run = 0; run < kRuns; ++run) {
      std::vector<VectorXd> stretches(count, VectorXd(60));
      for (VectorXd& x : stretches) {
        for (double& value : x) value = Normal(&random);
      }
      variance +=
          std::pow(FitAutoregression(stretches, false).stddev(), 2) / kRuns;
    }
    EXPECT_NEAR(variance, 1, .12) << count;
  }
}

TEST(Autoregression, OfAFewSamplesOnlyTheVarianceIsKnown) {
  VectorXd x(20);
  for (int k = 0; k < 20; ++k) x[k] = k % 2 ? 3 : -3;
  const Autoregression noise = FitAutoregression({x}, false);
  EXPECT_EQ(noise.a.norm(), 0);
  EXPECT_NEAR(noise.sigma, 3, 1e-12);
  EXPECT_EQ(FitAutoregression({}, false).sigma, 1);
}

// In closed form, at the precision of 2e5 samples.
TEST(Autoregression, YuleWalkerIsThatOfAllSamples) {
  std::mt19937_64 random(5);
  const Autoregression noise =
      FitYuleWalker({Ar2(&random, 150000), Ar2(&random, 50000)});
  EXPECT_NEAR(noise.a[0], kA1, .01);
  EXPECT_NEAR(noise.a[1], kA2, .01);
  EXPECT_NEAR(noise.sigma, kSigma, .01);
  // What comes and goes counts, unlike in what FitAutoregression hears.
  VectorXd x = Ar2(&random, 20000);
  x.segment(9000, 1000).array() += 20;
  EXPECT_GT(FitYuleWalker({x}).stddev(), 3 * StddevOfAr2());
  EXPECT_NEAR(FitAutoregression({x}, false).stddev() / StddevOfAr2(), 1, .1);
  EXPECT_EQ(FitYuleWalker({}).sigma, 1);
}

}  // namespace armcal::autoregression_test

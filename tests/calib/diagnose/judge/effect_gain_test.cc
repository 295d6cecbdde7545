#include "calib/diagnose/judge/effect_gain.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace armcal::effect_gain_test {

using Eigen::MatrixXd;

constexpr double kStill = std::numeric_limits<double>::quiet_NaN();
constexpr int kSamples = 400;

// What both leave is orthogonal to what the effect changes, so that
// (e + d)^2 - e^2 has the mean d^2.
TEST(GainBetween, IsWhatTheEffectChangesWhereItIsThere) {
  MatrixXd left(kSamples, 2);
  for (int k = 0; k < kSamples; ++k) left.row(k).setConstant(k % 2 ? 3 : -3);
  MatrixXd without = left;
  without.col(1).array() += .5;
  const EffectGain gain = GainBetween(without, left, 1);
  EXPECT_NEAR(gain.value, .25 / 2, 1e-12);
  EXPECT_NEAR(gain.expected, .25 / 2, 1e-12);
  EXPECT_FALSE(gain.IsNone());
  // It is not there: its torque is added to residuals that had none of it.
  const EffectGain none = GainBetween(left, without, 1);
  EXPECT_NEAR(none.value, -.25 / 2, 1e-12);
  EXPECT_NEAR(none.expected, .25 / 2, 1e-12);
  EXPECT_TRUE(none.IsNone());
}

TEST(GainBetween, WhereAJointStandsIsNoGain) {
  MatrixXd left(4, 1), without(4, 1);
  left << 1, kStill, 1, kStill;
  without << 2, 9, 3, kStill;
  EXPECT_NEAR(GainBetween(without, left, 1).value, (3 + 8) / 2., 1e-12);
  EXPECT_EQ(GainBetween(without, MatrixXd::Constant(4, 1, kStill), 1).value, 0);
}

// Another gap of ten times the size, which swings slowly, hides whether a small
// effect is there; the interval holds the gain that it would have.
TEST(GainBetween, WhatAnotherGapHidesIsNeitherSeenNorMissed) {
  MatrixXd left(kSamples, 1), effect(kSamples, 1);
  for (int k = 0; k < kSamples; ++k) {
    left(k, 0) = 5 * std::cos(2 * M_PI * k / 310.);
    effect(k, 0) = .5 * std::cos(2 * M_PI * k / 97. + 1);
  }
  EffectGain gain = GainBetween(left, left + effect, 1);
  if (gain.value > 0) gain = GainBetween(left, left - effect, 1);
  EXPECT_LT(gain.value, 0);
  EXPECT_GT(gain.ci95[1], gain.expected);
  EXPECT_FALSE(gain.IsNone());
}

// Of independent residuals the mean of 2 e d + d^2 is normal with the variance
// 4 sigma^2 d^2 / N.
TEST(GainBetween, ItsIntervalIsThatOfTheMean) {
  constexpr int kRuns = 200;
  constexpr double kChange = .4;
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  int held = 0;
  for (int run = 0; run < kRuns; ++run) {
    const MatrixXd left =
        MatrixXd::NullaryExpr(kSamples, 1, [&] { return normal(random); });
    const EffectGain gain = GainBetween(left.array() + kChange, left, run + 1);
    held += gain.ci95[0] < gain.expected && gain.expected < gain.ci95[1];
    EXPECT_NEAR(gain.ci95[1] - gain.ci95[0],
                2 * 1.96 * 2 * kChange / std::sqrt(kSamples), .08);
  }
  // 95 % of 200, three standard deviations.
  EXPECT_NEAR(held, 190, 3 * std::sqrt(200 * .95 * .05));
}

}  // namespace armcal::effect_gain_test

#include "calib/diagnose/select/evidence_noise.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <random>

#include "tests/fixtures/sample_motion.h"

namespace armcal::evidence_noise_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kRows = 2000, kBaseline = 20;
constexpr double kSigma = 3;

class EvidenceNoiseTest : public testing::Test {
 protected:
  // x_k = keep x_{k-1} + e_k, of standard deviation kSigma.
  VectorXd Noise(double keep) {
    VectorXd x(kRows);
    double last = Normal(&random_);
    for (double& value : x) {
      last = keep * last + std::sqrt(1 - keep * keep) * Normal(&random_);
      value = kSigma * last;
    }
    return x;
  }
  // One joint, its rows whitened as if the noise were 1.
  GapScreen Screen(const VectorXd& target, double prior) {
    MatrixXd baseline(kRows, kBaseline);
    for (double& value : baseline.reshaped()) value = prior * Normal(&random_);
    GapScreen screen(OnEachJoint({baseline}), kBaseline, {target});
    screen.Factor();
    return screen;
  }
  static GapScreen With(GapScreen screen, const VectorXd& column) {
    screen.AddColumn({column});
    screen.Factor();
    return screen;
  }

  std::mt19937_64 random_{5};
};

// Rows that the baseline fits are not noise that is small.
TEST_F(EvidenceNoiseTest, TellsTheVarianceGivenWhatIsFitted) {
  const EvidenceNoise noise =
      SettleNoise(Screen(Noise(0), 1), VectorXd::Ones(1));
  EXPECT_NEAR(noise.variance[0], kSigma * kSigma, .1 * kSigma * kSigma);
  EXPECT_NEAR(noise.time[0], 1, .3);
  EXPECT_NEAR(noise.fitted[0], kBaseline, .1 * kBaseline);
}

// Of an autoregression of the first order: (1 + keep) / (1 - keep).
TEST_F(EvidenceNoiseTest, CorrelatedRowsTellLess) {
  const EvidenceNoise noise =
      SettleNoise(Screen(Noise(.8), .01), VectorXd::Ones(1));
  EXPECT_NEAR(noise.time[0], 9, 3);
  EXPECT_NEAR(noise.stddev()[0], 3 * kSigma, .6 * kSigma);
}

// N log of the ratio of variances, N being what the larger model leaves
// independent: a slow wave is correlated until it is in the model.
TEST_F(EvidenceNoiseTest, TheLargerModelSaysHowManyRowsAreIndependent) {
  VectorXd wave(kRows);
  for (int k = 0; k < kRows; ++k) wave[k] = 2 * kSigma * std::sin(.01 * k);
  const GapScreen smaller = Screen(wave + Noise(0), 1e-3);
  const EvidenceNoise noise = SettleNoise(smaller, VectorXd::Ones(1));
  EXPECT_GT(noise.time[0], 50);
  const double odds = CompareLarger(smaller, With(smaller, wave), noise).odds;
  EXPECT_NEAR(odds, kRows * std::log(3.), .15 * kRows * std::log(3.));
}

TEST_F(EvidenceNoiseTest, AColumnOfNothingGainsNothing) {
  const GapScreen smaller = Screen(Noise(0), 1e-3);
  const EvidenceNoise noise = SettleNoise(smaller, VectorXd::Ones(1));
  EXPECT_LT(
      std::abs(CompareLarger(smaller, With(smaller, Noise(0)), noise).odds),
      12);
}

// What the rows hold of the columns, their size is chosen by; not larger.
TEST_F(EvidenceNoiseTest, EvidenceTellsTheSizeOfNuisances) {
  for (const double size : {.1, 1.}) {
    GapScreen routine = Screen(VectorXd::Zero(kRows), 10);
    const VectorXd x = VectorXd::NullaryExpr(
        kBaseline, [&] { return size * Normal(&random_); });
    MatrixXd columns(kRows, kBaseline);
    for (double& value : columns.reshaped()) value = 10 * Normal(&random_);
    GapScreen screen(OnEachJoint({columns}), kBaseline,
                     {columns * x + Noise(0)});
    screen.Factor();
    const EvidenceNoise noise = SettleNoise(screen, VectorXd::Ones(1));
    GapScreen smaller = screen;
    std::vector<int> all(kBaseline);
    std::iota(all.begin(), all.end(), 0);
    smaller.ScaleBaseline(all, .1);
    const double odds =
        LogEvidence(screen, noise) - LogEvidence(std::move(smaller), noise);
    EXPECT_EQ(odds > 0, size == 1) << odds;
  }
}

}  // namespace armcal::evidence_noise_test

#include "calib/diagnose/judge/confirmation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace armcal::confirmation_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;

class GapConfirmationTest : public testing::Test {
 protected:
  GapConfirmationTest()
      : noise_(4000),
        effect_(4000),
        chi2_(std::vector<BaselineColumns>(2, {{0}, MatrixXd::Zero(4000, 1)}),
              MatrixXd::Ones(1, 1)) {
    std::mt19937_64 random(2);
    std::normal_distribution<double> normal;
    for (double& x : noise_) x = normal(random);
    effect_ = .5 * VectorXd::LinSpaced(4000, 0, 300).array().sin();
  }

  VectorXd noise_, effect_;
  PredictedChi2 chi2_;  // of a fit without errors
};

// Squares of .5 sin are 500, those of twice it 2000.
TEST_F(GapConfirmationTest, OfWhatIsThere) {
  const Confirmation found =
      Confirm(chi2_, {noise_ + effect_, {}}, {noise_, {}});
  EXPECT_NEAR(found.expected, 500, 10);
  EXPECT_NEAR(found.Share(), 1, .25);
}

TEST_F(GapConfirmationTest, OfWhatIsNotThere) {
  const Confirmation none = Confirm(chi2_, {noise_}, {noise_ - effect_});
  EXPECT_NEAR(none.Share(), -1, .15);
  // Half of what the effect says: nothing is gained.
  const Confirmation half =
      Confirm(chi2_, {noise_ + .5 * effect_}, {noise_ - .5 * effect_});
  EXPECT_NEAR(half.Share(), 0, .15);
}

TEST_F(GapConfirmationTest, WhatIsTooSmallTellsNothing) {
  const VectorXd small = .02 * effect_;
  const Confirmation found = Confirm(chi2_, {noise_ + small}, {noise_});
  EXPECT_LT(std::abs(found.Share()), .3);
}

// What an error of the fit's values would be as well tells nothing, however
// much it changes.
TEST_F(GapConfirmationTest, WhatTheFitMayHaveWrongTellsNothing) {
  const VectorXd shape = effect_ / effect_.norm();
  const PredictedChi2 unknown({{{0}, shape}}, 1e-4 * MatrixXd::Ones(1, 1));
  const Confirmation found = Confirm(unknown, {noise_ - effect_}, {noise_});
  EXPECT_NEAR(found.expected, 500. / (1 + 1e4), 1e-3);
  EXPECT_LT(std::abs(found.Share()), .1);
}

// A law acts in every part: one that two of three have is seen by their sum and
// not by the part that lacks it.
TEST_F(GapConfirmationTest, OfPartsTheLeastIsTold) {
  const Confirmation there =
      Confirm(chi2_, {noise_ + effect_, {}}, {noise_, {}});
  const Confirmation lacking = Confirm(chi2_, {noise_}, {noise_ - effect_});
  const std::vector<Confirmation> parts = {there, lacking, there};
  EXPECT_NEAR(SumOf(parts).expected, 1500, 30);
  // Of all three the noise is one, 2 / sqrt(500) standard deviations of each.
  EXPECT_NEAR(SumOf(parts).Share(), 1. / 3, 2 * 2 / std::sqrt(500.));
  EXPECT_EQ(LeastShare(parts), lacking.Share());
  EXPECT_EQ(LeastShare({}), 0);
}

}  // namespace armcal::confirmation_test

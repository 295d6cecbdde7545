#include "calib/diagnose/candidates/effect_odds.h"

#include <gtest/gtest.h>

#include <memory>

#include "model/signals/delayed_signal.h"
#include "tests/fixtures/effect_arm.h"
#include "tests/fixtures/gap_segment.h"

namespace armcal::effect_odds_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kNoise = .1;      // N m
constexpr double kBandwidth = 6;   // Hz
constexpr double kDelay = .01;     // s
constexpr double kStiffness = 20;  // N m/rad, of a spring on the second joint

class ShareInTest : public testing::Test {
 protected:
  ShareInTest()
      : arm_("PUMA560 6R", 20, .01),
        baseline_(arm_.robot, {}, VectorXd::Constant(6, 10)) {}

  MatrixXd Nominal() const {
    return RecordedTorque(arm_.robot, baseline_.transitions(), arm_.motion)
        .nominal();
  }
  // What a log of this torque, with noise, has of an effect.
  ShareOfEffect Share(const std::string& effect, int joint, const VectorXd& p,
                      MatrixXd tau) {
    AddNoise(&random_, VectorXd::Constant(6, kNoise), &tau);
    GapData data({MakeSegment(arm_.motion, tau)}, baseline_, kBandwidth);
    Autoregression white;
    white.sigma = kNoise;
    data.SetNoise(std::vector<Autoregression>(6, white));
    GapCandidate candidate;
    candidate.effect = FindEffect(effect);
    candidate.joint = joint;
    candidate.p = p;
    return ShareIn(baseline_, arm_.scale, candidate, data.Screen(), &data);
  }
  MatrixXd Spring(double share) const {
    MatrixXd tau = Nominal();
    tau.col(1) += share * kStiffness * arm_.motion.q.col(1);
    return tau;
  }
  // By this the torque is recorded late; or of it friction alone.
  MatrixXd Late(bool all) const {
    const MatrixXd nominal = Nominal();
    if (all) return Delayed(nominal, kDelay / arm_.motion.dt);
    Robot smooth = arm_.robot;
    for (Link& link : smooth.links) link.joint.coulomb = 0;
    const MatrixXd without =
        RecordedTorque(smooth, baseline_.transitions(), arm_.motion).nominal();
    return without + Delayed(nominal - without, kDelay / arm_.motion.dt);
  }

  EffectArm arm_;
  GapBaseline baseline_;
  std::mt19937_64 random_{9};
};

TEST_F(ShareInTest, IsHowMuchOfAnEffectLogsHave) {
  const Eigen::Vector2d p(kStiffness, 0);
  EXPECT_NEAR(Share("spring", 1, p, Spring(1)).share, 1, .05);
  EXPECT_NEAR(Share("spring", 1, p, Spring(.3)).share, .3, .05);
  EXPECT_NEAR(Share("spring", 1, p, Spring(0)).share, 0, .05);
  EXPECT_GT(Share("spring", 1, p, Spring(.6)).odds(), 0);
  EXPECT_LT(Share("spring", 1, p, Spring(.4)).odds(), 0);
}

TEST_F(ShareInTest, WhatIsFarLargerIsSomethingElse) {
  const Eigen::Vector2d p(kStiffness, 0);
  EXPECT_TRUE(Share("spring", 1, p, Spring(1.3)).IsOfThisSize());
  const ShareOfEffect larger = Share("spring", 1, p, Spring(3));
  EXPECT_FALSE(larger.IsOfThisSize());
  EXPECT_EQ(larger.odds(), 0);
}

// A spring that was weakened or taken off was there before, as strong at least.
TEST_F(ShareInTest, WhatLogsDoNotHaveTheyCannotLose) {
  const Eigen::Vector2d lost(-kStiffness, 0);
  EXPECT_TRUE(Share("spring", 1, lost, Spring(1)).CouldBeLost());
  EXPECT_TRUE(Share("spring", 1, lost, Spring(2)).CouldBeLost());
  EXPECT_FALSE(Share("spring", 1, lost, Spring(0)).CouldBeLost());
  EXPECT_FALSE(Share("spring", 1, lost, Spring(-1)).CouldBeLost());
}

// Two deviations of chance for all of it.
TEST(ShareOfEffect, SaysNothingOfWhatItWouldNotShow) {
  const ShareOfEffect untold = {0, 4};
  EXPECT_FALSE(untold.IsTold());
  EXPECT_TRUE(untold.CouldBeLost());
  const ShareOfEffect told = {0, 400};
  EXPECT_TRUE(told.IsTold());
  EXPECT_FALSE(told.CouldBeLost());
}

// Friction that changes sign late is no delay of all torque.
TEST_F(ShareInTest, AFrictionsOwnTimeIsNoDelay) {
  const VectorXd p = VectorXd::Constant(1, -kDelay);
  EXPECT_NEAR(Share("delay", -1, p, Late(true)).share, 1, .1);
  EXPECT_NEAR(Share("delay", -1, p, Late(false)).share, 0, .1);
}

}  // namespace armcal::effect_odds_test
